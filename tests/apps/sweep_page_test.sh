#!/usr/bin/env bash
# The page of a sweep in a real browser: loads without a word on the console, the slider changes the picture, nothing is
# wider than a phone. Without a Chromium it is skipped, exit code 77, unless PDC_NEED_BROWSER is set: then it fails.
# Usage: sweep_page_test.sh ROOT PDC
set -euo pipefail
readonly root=$1 pdc=$2

browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)
if [[ -z "$browser" ]]; then
  echo "no chromium here (Debian: apt-get install chromium); THE SWEEP'S PAGE WAS NOT LOOKED AT"
  [[ -z "${PDC_NEED_BROWSER-}" ]] || exit 1
  exit 77
fi

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$pdc" sweep "$root/scenes/rotated_box.yaml" "$scratch/out" --sigma-n 0,0.1,inf --voxel-size 0.1 --quiet

# A copy that first notes errors, then plays a reader and tells the page around it what it saw; and a page around it,
# as a window cannot be as narrow as a phone.
awk '
  /<meta charset/ { print; print "<script>window.trouble = []; onerror = (m) => { trouble.push(m); };</script>"; next }
  /<\/body>/ {
    print "<script>addEventListener(\"load\", () => {"
    print "  const picture = document.getElementById(\"picture\"), slider = document.getElementById(\"step\");"
    print "  const value = () => document.getElementById(\"value\").textContent, before = picture.src, first = value();"
    print "  slider.value = 2; slider.dispatchEvent(new Event(\"input\"));"
    print "  const other = picture.src !== before && picture.src.startsWith(\"data:image/png\");"
    print "  const last = value(), marked = document.querySelectorAll(\"tbody tr.chosen\").length;"
    print "  document.querySelectorAll(\".sheet button\")[0].click();"
    print "  const back = picture.src === before, width = document.documentElement;"
    print "  parent.postMessage([\"SEEN\", first, last, other, marked, back, picture.naturalWidth, innerWidth,"
    print "    width.scrollWidth <= width.clientWidth, document.querySelectorAll(\"svg\").length > 3,"
    print "    trouble.length].join(\" \"), \"*\");"
    print "});</script>"
  }
  { print }' "$scratch/out/index.html" >"$scratch/out/played.html"

frame() {
  cat >"$scratch/out/frame_$1.html" <<EOF
<title>nothing</title><script>onmessage = (e) => { document.title = e.data; };</script>
<iframe src="played.html" width="$1" height="800" style="border: 0"></iframe>
EOF
}

look() {
  timeout 60 "$browser" --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-sync \
    --disable-background-networking --disable-component-update --user-data-dir="$scratch/profile" \
    --enable-logging=stderr --window-size=1300,900 --virtual-time-budget=5000 --dump-dom "file://$scratch/out/$1" \
    2>"$scratch/log"
}

failures=0
complain() {
  echo "$1"
  failures=$((failures + 1))
}
for width in 1200 390; do
  frame "$width"
  look "frame_$width.html" >"$scratch/dom"
  seen=$(grep -o '<title>[^<]*' "$scratch/dom")
  expected="<title>SEEN 0 inf true 1 true 480 $width true true 0"
  [[ "$seen" == "$expected" ]] || complain "at $width pixels: saw '$seen', wanted '$expected'"
  if grep CONSOLE "$scratch/log"; then complain "at $width pixels: words on the console"; fi
done
look index.html >"$scratch/dom"
grep -q 'id="picture"[^>]*src="data:image/png' "$scratch/dom" || complain "no picture at first"
if grep CONSOLE "$scratch/log"; then complain "words on the console"; fi
((failures == 0)) && echo "the page works at 1200 and 390 pixels"
