#!/usr/bin/env bash
# Draco's sources as Debian packs them, by apt from a source list that nobody else sees, and only if they are the ones
# that this project knows. ./draco_source.sh FOLDER: afterwards FOLDER/draco holds src/draco.
set -euo pipefail
folder=$(mkdir -p "$1" && cd "$1" && pwd)
version=1.5.5+dfsg-2
sha256=0d4ff5b218a2f9d836c6f44202918402591407b5f59a5103ec288c5600ab087f
[ -e "$folder/draco/.complete" ] && exit 0

# The archive that this machine's packages come from.
mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 'Origin: Debian' 'Label: Debian' | sort -u | head -1)
[ -n "$mirror" ] || { echo "draco_source.sh: this machine has no Debian archive in its package lists" >&2; exit 77; }
private=$folder/apt
mkdir -p "$private/lists/partial" "$private/parts"
echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror bookworm main" >"$private/sources.list"
options=(-o "Dir::Etc::SourceList=$private/sources.list" -o "Dir::Etc::SourceParts=$private/parts"
  -o "Dir::State::Lists=$private/lists" -o "Dir::Cache::pkgcache=" -o "Dir::Cache::srcpkgcache=" -o APT::Sandbox::User=)
apt-get -q "${options[@]}" update
(cd "$private" && apt-get -q "${options[@]}" source --download-only "draco=$version")

archive=$private/draco_${version%-*}.orig.tar.xz
echo "$sha256  $archive" | sha256sum --check --quiet
rm -rf "$folder/draco"
mkdir "$folder/draco"
tar -C "$folder/draco" --strip-components=1 -xf "$archive"
touch "$folder/draco/.complete"
