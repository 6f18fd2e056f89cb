#!/usr/bin/env bash
# Includes only ever point down: codec <- gltf_ext <- tools <- tests, and within the codec the walk knows no bits and
# the decoder no input mesh. Prints every include that does not, and fails.
set -u
cd "$(dirname "$0")/.."
bad=0

forbid() {  # REASON PATTERN FILE...
  local reason=$1 pattern=$2 found
  shift 2
  found=$(grep -nHE "^[[:space:]]*#[[:space:]]*include[[:space:]]*[<\"]($pattern)" "$@" 2>/dev/null) || return 0
  printf '%s\n' "$found" | sed "s|\$|    <- $reason|"
  bad=1
}

# Everything that a file includes, directly or not, from the codec.
closure() {
  local seen=" " queue=("$@") file next
  while [ ${#queue[@]} -gt 0 ]; do
    file=${queue[0]}
    queue=("${queue[@]:1}")
    case $seen in *" $file "*) continue ;; esac
    [ -e "$file" ] || continue
    seen+="$file "
    while read -r next; do queue+=("$next"); done < <(sed -n 's/^#include "\(codec\/[^"]*\)".*/\1/p' "$file")
  done
  echo "$seen"
}

shopt -s nullglob
codec=(codec/*.h codec/*.cpp)
gltf=(gltf_ext/*.h gltf_ext/*.cpp)
tools=(tools/*.h tools/*.cpp)

forbid "the codec knows nothing above it" '(gltf_ext|tools|tests)/' "${codec[@]}"
forbid "the codec uses the standard library only" '(draco|nlohmann|tiny_gltf|CLI|assimp|gtest)' "${codec[@]}"
forbid "the glTF side knows nothing above it" '(tools|tests)/' "${gltf[@]}"
forbid "the tools know no tests" 'tests/' "${tools[@]}"

read -ra walk <<<"$(closure codec/walk.h)"
read -ra decode <<<"$(closure codec/decode.h codec/decode.cpp)"
forbid "the walk knows no bits" 'codec/range_coder\.h' ${walk[@]+"${walk[@]}"}
forbid "the decoder knows no input mesh" 'codec/(topology|mesh_oracle)\.h' ${decode[@]+"${decode[@]}"}

mapfile -t with_draco < <(grep -lE '^#include [<"]draco/' "${gltf[@]}" | sed 's/\.[a-z]*$//' | sort -u)
mapfile -t with_tinygltf < <(grep -lE '^#include [<"]tiny_gltf\.h' "${gltf[@]}" | sed 's/\.[a-z]*$//' | sort -u)
[ ${#with_tinygltf[@]} -le 1 ] || { echo "tiny_gltf.h is included by more than one unit: ${with_tinygltf[*]}"; bad=1; }
printf 'floors: %d + %d + %d files, Draco in: %s\n' ${#codec[@]} ${#gltf[@]} ${#tools[@]} "${with_draco[*]-none}"
exit $bad
