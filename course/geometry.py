"""Triangles of the course's levels: metres, +Y up, right-handed, counter-clockwise seen from the front."""
import math


def rotate_y(angle, point):
    """Counter-clockwise seen from above: +X towards -Z."""
    c, s = math.cos(angle), math.sin(angle)
    x, y, z = point
    return (c * x + s * z, y, c * z - s * x)


class Mesh:
    def __init__(self):
        self.positions, self.triangles = [], []

    def polygon(self, *corners):
        """A flat convex polygon as a fan."""
        first = len(self.positions)
        self.positions += [tuple(map(float, corner)) for corner in corners]
        self.triangles += [(first, first + i, first + i + 1) for i in range(1, len(corners) - 1)]
        return self

    def floor(self, x0, x1, z0, z1, y=0.0, nx=1, nz=1, height=None):
        """A grid that faces up; `height(x, z)` instead of `y`; diagonals alternate."""
        height = height or (lambda x, z: y)
        first = len(self.positions)
        for i in range(nx + 1):
            for k in range(nz + 1):
                x, z = x0 + (x1 - x0) * i / nx, z0 + (z1 - z0) * k / nz
                self.positions.append((x, height(x, z), z))
        for i in range(nx):
            for k in range(nz):
                a = first + i * (nz + 1) + k
                b, c, d = a + 1, a + nz + 2, a + nz + 1
                self.triangles += [(a, b, c), (a, c, d)] if (i + k) % 2 else [(a, b, d), (b, c, d)]
        return self

    def box(self, low, high, inward=False):
        (x0, y0, z0), (x1, y1, z1) = low, high
        p = [(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1)]
        for face in ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)):
            corners = [p[i] for i in face]
            self.polygon(*(reversed(corners) if inward else corners))
        return self

    def path(self, points, z0, z1):
        """A strip whose profile is the line of (x, y) points, x ascending; faces up."""
        for (xa, ya), (xb, yb) in zip(points, points[1:]):
            self.polygon((xa, ya, z0), (xa, ya, z1), (xb, yb, z1), (xb, yb, z0))
        return self

    def wall(self, points, y0, y1, columns=1, rows=1):
        """Upright quads along the line of (x, z) points; they face the left side of the line seen from above."""
        for (xa, za), (xb, zb) in zip(points, points[1:]):
            for i in range(columns):
                for k in range(rows):
                    xs = [xa + (xb - xa) * t / columns for t in (i, i + 1)]
                    zs = [za + (zb - za) * t / columns for t in (i, i + 1)]
                    ys = [y0 + (y1 - y0) * t / rows for t in (k, k + 1)]
                    self.polygon((xs[0], ys[0], zs[0]), (xs[0], ys[1], zs[0]), (xs[1], ys[1], zs[1]), (xs[1], ys[0], zs[1]))
        return self

    def prism(self, profile, z0, z1):
        """A solid: a convex polygon of (x, y) points, counter-clockwise seen from +Z, from z0 to z1."""
        self.polygon(*[(x, y, z1) for x, y in profile])
        self.polygon(*[(x, y, z0) for x, y in reversed(profile)])
        for (xa, ya), (xb, yb) in zip(profile, profile[1:] + profile[:1]):
            self.polygon((xa, ya, z1), (xa, ya, z0), (xb, yb, z0), (xb, yb, z1))
        return self

    def column(self, outline, y0, y1):
        """A solid: a convex polygon of (x, z) points, counter-clockwise seen from above (+X towards -Z), from y0 to y1."""
        self.polygon(*[(x, y1, z) for x, z in outline])
        self.polygon(*[(x, y0, z) for x, z in reversed(outline)])
        for (xa, za), (xb, zb) in zip(outline, outline[1:] + outline[:1]):
            self.polygon((xa, y0, za), (xb, y0, zb), (xb, y1, zb), (xa, y1, za))
        return self

    def moved(self, change):
        """The same with change(point) for each position."""
        made = Mesh()
        made.positions = [tuple(change(p)) for p in self.positions]
        made.triangles = list(self.triangles)
        return made


def circle(n, radius, x=0.0, z=0.0, turn=0.0):
    """(x, z) points, counter-clockwise seen from above."""
    return [(x + radius * math.cos(turn + 2 * math.pi * i / n), z - radius * math.sin(turn + 2 * math.pi * i / n)) for i in range(n)]


def turn_y(angle):
    """A quaternion x, y, z, w."""
    return [0.0, math.sin(angle / 2), 0.0, math.cos(angle / 2)]
