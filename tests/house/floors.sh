#!/usr/bin/env bash
# Nothing includes a higher floor, nor, within a floor, a higher room, and no rooms include each other in a circle: looks
# at every #include line of include/pdc, src, apps and python, and prints which rooms know which. Usage: floors.sh ROOT
set -euo pipefail
cd "$1"

# By folder. A floor's own files stand above all of its rooms, or below them where it is a seam that they share.
declare -A floor_of=(
  [parallel]=0 [math]=1 [mesh]=2 [rays]=3 [simplify]=3 [smooth]=3 [subdivide]=3 [field]=4 [sample]=5 [extract]=6 [render]=6
  [grid]=7 [points]=7 [io]=8 [study]=9 [tile]=9
)
readonly ground=-1 apps=10 python=11
# By folder within a floor. Rooms of one rank do not know each other.
declare -A room_of=(
  [mesh]=0 [mesh/welding]=1 [mesh/polygons]=1 [mesh/intersections]=1 [mesh/local]=1 [mesh/reports]=2 [mesh/winding]=2
  [simplify]=0 [simplify/clustering]=1 [simplify/error_bound]=1 [simplify/pair_contraction]=1 [simplify/decimation]=2
  [sample]=0 [sample/creases]=1 [sample/implicit]=1 [sample/meaning]=1 [sample/mesh]=2 [sample/stencils]=2
  [sample/dense]=3 [sample/vdb]=3
  [extract/topology]=0 [extract/vertices]=1 [extract/faces]=2 [extract/conflicts]=3 [extract/certify]=4 [extract]=5
  [grid]=0 [grid/dense]=1 [grid/description]=1
  [field]=0 [field/primitives]=1 [field/operators]=1
  [io/file]=0 [io/deflate]=1 [io/parse]=1 [io/openmesh]=2 [io/mesh]=3 [io/vdb]=1 [io/volume]=2 [io/scene]=4 [io/points]=4 [io]=5
  [study/view]=0 [study]=1
  [apps/terminal]=0 [apps/files]=1 [apps/requests]=2 [apps/reports]=3 [apps/tiles]=4 [apps/commands]=5 [apps/commands/points]=5 [apps/commands/pictures]=5 [apps/commands/slabs]=5
  [apps]=6
  [python/inputs]=0 [python/groups]=1 [python]=2
)

# Sets `floor`, `room` and `rank` to those of a path below include/pdc or src, or of the text of an #include: by its
# folder; files beside the folders (pdc/error.h) are the ground that everything stands on.
find_place() {
  local folder=${1%/*} top=${1%%/*}
  room=$folder
  rank=0
  if [[ "$1" != */* ]]; then
    floor=$ground
    room=ground
    return
  elif [[ "$top" == apps || "$top" == terminal || "$top" == files || "$top" == requests || "$top" == reports || "$top" == tiles || "$top" == commands ]]; then
    floor=$apps
    [[ "$top" == apps ]] || room=apps/$folder
  elif [[ "$top" == python || "$top" == inputs || "$top" == groups ]]; then
    floor=$python
    room=python/${folder#python/src/}
    [[ "$folder" != python/* || "$folder" == python/src/* ]] || room=python
  elif [[ -n "${floor_of[$top]-}" ]]; then
    floor=${floor_of[$top]}
  else
    echo "unknown folder '$top' in $1"
    exit 1
  fi
  if [[ -n "${room_of[$room]-}" ]]; then
    rank=${room_of[$room]}
  elif [[ "$room" == */* ]]; then
    echo "unknown room '$room' in $1"
    exit 1
  fi
}

failures=0
checked=0
declare -A arrows=()  # "room other": the first includes files of the other.
while IFS=: read -r file line; do
  [[ "$line" =~ \"(pdc/)?([^\"]+)\" ]] || continue
  included=${BASH_REMATCH[2]}
  path=${file#include/pdc/}
  find_place "${path#src/}"
  own_floor=$floor own_room=$room own_rank=$rank
  find_place "$included"
  checked=$((checked + 1))
  [[ "$room" == "$own_room" ]] || arrows["$own_room $room"]=1
  if ((floor > own_floor)); then
    echo "$file includes a higher floor: $included"
    failures=$((failures + 1))
  elif ((floor == own_floor)) && [[ "$room" != "$own_room" ]] && ((rank >= own_rank)) &&
    [[ "${room%%/*}" == "${own_room%%/*}" ]]; then
    echo "$file includes a room that is not below its own: $included"
    failures=$((failures + 1))
  fi
done < <(grep -rE --include='*.h' --include='*.cpp' '^ *# *include "' include/pdc src apps python)

# A room stands one level above the highest that it knows. In a circle there is no such level.
declare -A level=() knows=()
for arrow in "${!arrows[@]}"; do
  level[${arrow% *}]=0
  level[${arrow#* }]=0
  knows[${arrow% *}]+=" ${arrow#* }"
done
for ((rounds = 0; rounds <= ${#level[@]}; ++rounds)); do
  raised=()
  for room in "${!level[@]}"; do
    for other in ${knows[$room]-}; do
      ((level[$room] > level[$other])) || { level[$room]=$((level[$other] + 1)) && raised+=("$room"); }
    done
  done
  ((${#raised[@]} > 0)) || break
done
for room in "${!level[@]}"; do
  echo "level ${level[$room]}: $room knows $(xargs -n 1 <<<"${knows[$room]-nothing}" | sort | xargs)"
done | sort -t ' ' -k 2n -k 3
echo "${#arrows[@]} arrows between ${#level[@]} rooms"
if ((${#raised[@]} > 0)); then
  echo "rooms that include each other in a circle, or stand on one: $(printf '%s\n' "${raised[@]}" | sort -u | tr '\n' ' ')"
  failures=$((failures + 1))
fi

echo "$checked includes, $failures failures"
((failures == 0 && checked > 100))
