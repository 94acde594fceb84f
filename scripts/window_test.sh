#!/usr/bin/env bash
# Uses the editor in a real window (GLFW under Xvfb) with a real pointer and keyboard (xdotool): opens, paints,
# types, resizes, saves, closes, opens again, and looks at what is on disk. Writes pictures of the window.
#   scripts/window_test.sh [OUT] [PROGRAM]
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-out/window}
slipface=$(realpath "${2:-build/release/editor/slipface}")
for tool in Xvfb xdotool import convert compare display; do
    command -v "$tool" >/dev/null || { echo "$tool is missing: apt-get install xvfb xdotool imagemagick"; exit 64; }
done
mkdir -p "$out"
work=$(mktemp -d)
pids=()
finish() {
    for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
    rm -rf "$work"
}
trap finish EXIT
export XDG_CONFIG_HOME=$work/config XDG_STATE_HOME=$work/state XDG_CACHE_HOME=$work/cache
mkdir -p "$XDG_CONFIG_HOME/slipface"
echo "tour.done = on" >"$XDG_CONFIG_HOME/slipface/preferences"
cp assets/levels/easy.* "$work/"
cp -r assets/levels/textures "$work/"

display=:$((90 + RANDOM % 400))
Xvfb "$display" -screen 0 1600x1000x24 -nolisten tcp >/dev/null 2>&1 &
pids+=($!)
export DISPLAY=$display
for _ in $(seq 100); do xdotool getdisplaygeometry >/dev/null 2>&1 && break; sleep 0.1; done

step() { echo "  $1"; }
fail() { echo "FAILED: $1"; import -window root "$out/failed.png" || true; exit 1; }
# Waits until the window's title matches; the program says what it has done.
wait_title() {
    for _ in $(seq 300); do
        title=$(xdotool getwindowname "$window" 2>/dev/null || true)
        [[ $title == $1 ]] && return
        sleep 0.1
    done
    fail "the title is \"$title\", expected \"$1\""
}
start() {
    "$slipface" "$work/easy.obj" &
    editor=$!
    pids+=("$editor")
    window=$(timeout 60 xdotool search --sync --onlyvisible --class slipface | head -1) || fail "no window"
    xdotool windowfocus "$window" 2>/dev/null || true
    wait_title "easy.obj*"
    sleep 1
}
key() { xdotool key --clearmodifiers "$1"; sleep 0.4; }
quit() {
    key ctrl+q
    for _ in $(seq 100); do kill -0 "$editor" 2>/dev/null || return 0; sleep 0.1; done
    fail "it did not end"
}

step "opens"
start
step "paints"
key b
key 1
xdotool mousemove --window "$window" 700 560
xdotool mousedown 1
for x in 720 740 760 780 800; do xdotool mousemove --window "$window" $x 560; sleep 0.1; done
xdotool mouseup 1
wait_title "easy.obj*•*"
import -window "$window" "$out/painted.png"
step "undoes and redoes"
key ctrl+z
wait_title "easy.obj — Slipface"
key ctrl+shift+z
wait_title "easy.obj*•*"
step "idles: no frames, next to no CPU"
xdotool mousemove --window "$window" 700 700
sleep 2
before=$(awk '{print $14 + $15}' "/proc/$editor/stat")
sleep 10
after=$(awk '{print $14 + $15}' "/proc/$editor/stat")
echo "    $((after - before)) of 1000 ticks of CPU in 10 s"
[ $((after - before)) -le 10 ] || fail "it used more than 1 % of a CPU while idle"
step "walks, and stops walking when the window loses the focus"
convert -size 60x60 xc:grey "$work/other.png"
display -geometry +1500+0 "$work/other.png" &
pids+=($!)
other=$(timeout 20 xdotool search --sync --onlyvisible --class display | head -1) || fail "no other window"
xdotool windowfocus "$window"
key F5
sleep 1 # for the first frame on a slow machine
xdotool keydown w
sleep 1
import -window "$window" "$out/walking.png"
xdotool windowfocus "$other"
sleep 4
xdotool windowfocus "$window"
xdotool keyup w
sleep 0.3
key Escape
sleep 1
tape=$(find "$XDG_STATE_HOME/slipface/recordings" -name '*.tape' | head -1)
[ -n "$tape" ] || fail "the walk was not recorded"
# Lines "N" and "N wish X,Y": ticks at rest, and with the stick pushed.
read -r pushed rest < <(awk '$1 ~ /^[0-9]+$/ {if ($2 == "wish") p += $1; else r += $1} END {print p + 0, r + 0}' "$tape")
echo "    $pushed ticks pushed, $rest at rest"
[ "$pushed" -ge 3 ] || fail "the player did not walk"
[ "$rest" -ge "$pushed" ] || fail "the key counted on without the focus"
step "types: the palette undoes and redoes"
for what in undo redo; do
    key ctrl+p
    sleep 1
    xdotool type --delay 60 "$what"
    sleep 0.5
    import -window "$window" "$out/palette-$what.png"
    key Return
    if [ "$what" = undo ]; then wait_title "easy.obj — Slipface"; else wait_title "easy.obj*•*"; fi
done
key F1
sleep 0.5
import -window "$window" "$out/shortcuts.png"
key F1
step "resizes"
xdotool windowsize "$window" 1100 700
sleep 1
import -window "$window" "$out/resized.png"
step "larger interface, light theme by preferences"
key ctrl+equal
key ctrl+equal
import -window "$window" "$out/zoomed.png"
step "saves"
key ctrl+s
wait_title "easy.obj — Slipface"
quit
painted=$("$slipface" info "$work/easy.obj" --json | python3 -c 'import json,sys; print(json.load(sys.stdin)["painted_faces"])')
original=$("$slipface" info assets/levels/easy.obj --json | python3 -c 'import json,sys; print(json.load(sys.stdin)["painted_faces"])')
[ "$painted" -gt "$original" ] || fail "nothing was saved: $painted painted faces, $original before"
grep -q "zoom = 1.2" "$XDG_CONFIG_HOME/slipface/preferences" || fail "the interface's size was not remembered"
grep -q "window.width = 1100" "$XDG_CONFIG_HOME/slipface/preferences" || fail "the window's size was not remembered"
step "opens again, as it was left"
echo "theme = light" >>"$XDG_CONFIG_HOME/slipface/preferences"
start
size=$(xdotool getwindowgeometry --shell "$window" | awk -F= '/WIDTH/ {print $2}')
[ "$size" = 1100 ] || fail "the window is $size wide, expected 1100"
import -window "$window" "$out/reopened.png"
step "opens by a path that Tab completes, and by a part of the name"
cp assets/levels/hard.* "$work/"
key ctrl+o
sleep 1
xdotool type --delay 60 "$work/ha"
sleep 1
key Tab
sleep 1
import -window "$window" "$out/completed.png"
key Return
wait_title "hard.obj*"
key ctrl+o
sleep 1
xdotool type --delay 60 eas
sleep 1
import -window "$window" "$out/filtered.png"
key Return
wait_title "easy.obj*"
step "reads a file again that is written slowly, and stays saved"
cp "$work/easy.obj" "$work/whole"
echo "# written again" >>"$work/whole"
size=$(stat -c %s "$work/whole")
for part in $(seq 40); do head -c $((size * part / 40)) "$work/whole" >"$work/easy.obj"; sleep 0.05; done
sleep 4
wait_title "easy.obj — Slipface"
import -window "$window" "$out/reloaded.png"
step "shows textures and materials that another program has changed"
for texture in "$work"/textures/*.png; do convert "$texture" -negate "$texture"; done
sleep 4
import -window "$window" "$out/textures.png"
changed=$(compare -metric AE "$out/reloaded.png" "$out/textures.png" null: 2>&1 || true)
[ "${changed%%.*}" -gt 5000 ] || fail "changed textures are not seen ($changed pixels differ)"
sed -i 's/^map_Kd.*//; s/^Kd.*/Kd 0.1 0.8 0.1/' "$work/easy.mtl"
sleep 5
import -window "$window" "$out/materials.png"
changed=$(compare -metric AE "$out/textures.png" "$out/materials.png" null: 2>&1 || true)
[ "${changed%%.*}" -gt 5000 ] || fail "changed materials are not seen ($changed pixels differ)"
wait_title "easy.obj — Slipface"
step "asks before unsaved changes are lost; a kill leaves them for recovery"
key b
xdotool mousemove --window "$window" 480 320
sleep 0.3
xdotool mousedown 1
for x in 490 500 510 520; do xdotool mousemove --window "$window" $x 320; sleep 0.1; done
xdotool mouseup 1
wait_title "easy.obj*•*"
sleep 5 # the autosave comes three seconds after the last change
key ctrl+q
sleep 0.5
import -window "$window" "$out/unsaved.png"
kill -KILL "$editor"
wait "$editor" 2>/dev/null || true
start
sleep 1
import -window "$window" "$out/recover.png"
key Return
wait_title "easy.obj*•*"
import -window "$window" "$out/recovered.png"
kill "$editor"
echo "All steps done; pictures in $out"
