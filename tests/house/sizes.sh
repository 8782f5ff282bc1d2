#!/usr/bin/env bash
# How large things may be: lines of a file, files of a folder, lines of a function, parameters of a function.
# Usage: sizes.sh ROOT
set -euo pipefail
cd "$1"

readonly most_lines=400 most_files=25 most_function_lines=60 most_parameters=6

# What is larger, and how large it may be until it is mended. The list may only shrink: an entry that is not needed, or
# larger than needed, is an error too.
declare -A exceptions=()

found=$(mktemp)
trap 'rm -f "$found"' EXIT

sources() { find include src apps python tests bench \( -name '*.h' -o -name '*.cpp' \) | sort; }

# Each line: how large, the limit, what.
measure() {
  local file
  sources | while IFS= read -r file; do echo "$(wc -l <"$file") $most_lines lines of $file"; done
  sources | sed 's|/[^/]*$||' | sort | uniq -c | awk -v most=$most_files '{ print $1, most, "files in " $2 }'
  # Functions are the braces that stand, in scopes only, behind a parenthesis.
  sources | xargs awk -v most_lines=$most_function_lines -v most_parameters=$most_parameters '
    function plain(line,    at, rest) {  # Without strings, characters and comments.
      for (;;) {
        if (raw != "") {
          at = index(line, raw)
          if (at == 0) return ""
          line = substr(line, at + length(raw))
          raw = ""
        }
        while (match(line, /[0-9A-Fa-f]\047[0-9A-Fa-f]/)) line = substr(line, 1, RSTART) substr(line, RSTART + 2)
        if (!match(line, /R"[A-Za-z_]*\(/)) break
        raw = ")" substr(line, RSTART + 2, RLENGTH - 3) "\""
        rest = substr(line, RSTART + RLENGTH)
        at = index(rest, raw)
        if (at == 0) return substr(line, 1, RSTART - 1)
        line = substr(line, 1, RSTART - 1) substr(rest, at + length(raw))
        raw = ""
      }
      gsub(/"([^"\\]|\\.)*"/, "", line)
      gsub(/\047([^\047\\]|\\.)*\047/, "0", line)
      sub(/\/\/.*/, "", line)
      gsub(/\/\*[^*]*\*\//, "", line)
      return line
    }
    function signature(text) {
      gsub(/\[\[[^]]*\]\]/, "", text)
      gsub(/(alignas|decltype|explicit|__attribute__) *\([^()]*\)/, "", text)
      sub(/operator *\(\)/, "operator_call", text)
      return text
    }
    function parameters(text,    i, c, depth, count, any) {
      i = index(text, "(") + 1
      count = 1
      for (; i <= length(text); ++i) {
        c = substr(text, i, 1)
        if (c == ")" && depth == 0) break
        if (c ~ /[(<{[]/) ++depth
        if (c ~ /[)>}\]]/) --depth
        if (c == "," && depth == 0) ++count
        if (c !~ / /) any = 1
      }
      return any ? count : 0
    }
    function name(text,    test) {
      if (text ~ /^(TYPED_)?TEST(_[FP])? *\(/) {
        test = substr(text, index(text, "(") + 1)
        sub(/\).*/, "", test)
        sub(/, */, ".", test)
        return test
      }
      text = substr(text, 1, index(text, "(") - 1)
      sub(/ +$/, "", text)
      sub(/.* [*&]*/, "", text)
      return text
    }
    function declare(text) {
      text = signature(text)
      if (text ~ /\(/) print parameters(text), most_parameters, "parameters of " name(text) " in " FILENAME
    }
    FNR == 1 { depth = inside = round = 0; text = raw = ""; kind[0] = "scope"; directive = 0 }
    directive || /^ *#/ { directive = /\\$/; next }
    {
      line = plain($0)
      for (i = 1; i <= length(line); ++i) {
        c = substr(line, i, 1)
        if (c == "{") {
          if (inside || round > 0) {
            kind[++depth] = "inner"
            if (!inside) text = text c
            continue
          }
          head = signature(text)
          sub(/^template *<[^()]*> */, "", head)
          if (head ~ /(^|[ >])(namespace|class|struct|union|extern)( |$)/ && head !~ /\(/) {
            kind[++depth] = "scope"
          } else if (head ~ /\(/) {
            kind[++depth] = "function"
            inside = depth
            begin = first
            called = name(head)
            declare(text)
          } else {
            kind[++depth] = "inner"
            inside = depth
          }
          text = ""
        } else if (c == "}") {
          if (kind[depth] == "function")
            print FNR - begin + 1, most_lines, "lines of " called " in " FILENAME
          if (inside == depth) { inside = 0; text = ""; round = 0 }
          else if (!inside && kind[depth] == "inner") text = text c
          else if (!inside) text = ""
          --depth
        } else if (inside) {
          continue
        } else if (c == ";" && round == 0) {
          declare(text)
          text = ""
        } else {
          if (c == "(") ++round
          if (c == ")") --round
          if (text == "" && c == " ") continue
          if (text == "") first = FNR
          text = text c
          if (text ~ /^(public|private|protected):$/) text = ""
        }
      }
      if (text != "") text = text " "
    }'
}
measure >"$found"

failures=0
complain() {
  echo "$1"
  failures=$((failures + 1))
}
declare -A needed=()
while read -r size limit what; do
  ((size > limit)) || continue
  if [[ -z "${exceptions[$what]-}" ]]; then
    complain "$size $what; at most $limit"
  elif ((size > exceptions[$what])); then
    complain "$size $what; at most $limit, and by way of exception ${exceptions[$what]}"
  else
    echo "EXCEPTION: $size $what; at most $limit"
    needed[$what]=$size
  fi
done <"$found"
for what in "${!exceptions[@]}"; do
  [[ "${needed[$what]-}" == "${exceptions[$what]}" ]] ||
    complain "the exception for ${exceptions[$what]} $what is larger than needed: now ${needed[$what]:-within the limit}"
done

largest() { grep -E "^[0-9]+ [0-9]+ $1" "$found" | sort -rn | head -n 1 | sed -E 's/^([0-9]+) [0-9]+ /\1 /'; }
echo "the largest:"
for kind in 'lines of [^ ]+$' 'files in' 'lines of .* in' 'parameters of'; do echo "  $(largest "$kind")"; done
functions=$(grep -cE '^[0-9]+ [0-9]+ lines of .* in ' "$found")
echo "$functions functions, $failures complaints"
((failures == 0 && functions > 500))
