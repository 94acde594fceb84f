"""Every family of situations, registered by importing it."""
from families import edges, ground, jumps, moving, rooms, slopes, stairs, walls  # noqa: F401
