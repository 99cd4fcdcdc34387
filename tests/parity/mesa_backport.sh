#!/bin/sh
# A Vulkan device with ray queries on any machine: lavapipe of Mesa 25. Where the system has it, it is
# that one; on Debian 12 it comes from the backports and is unpacked into FOLDER, never installed.
#   tests/parity/mesa_backport.sh FOLDER COMMAND...    runs the command on it
#   eval "$(tests/parity/mesa_backport.sh FOLDER)"     the same for all that follows
# Needs no root; what FOLDER has is not fetched again. Exit code 77 where it cannot be had, with one
# line that says why.
set -u

skip() {
  echo "mesa_backport.sh: no device with ray queries here: $1" >&2
  exit 77
}

[ $# -ge 1 ] || { echo "usage: mesa_backport.sh FOLDER [COMMAND...]" >&2; exit 2; }
mkdir -p "$1" || exit 2
folder=$(cd "$1" && pwd)
shift
suite=bookworm-backports
keys=/usr/share/keyrings/debian-archive-keyring.gpg
architecture=$(dpkg --print-architecture 2>/dev/null) || skip "not a Debian system"
case $architecture in
  amd64) triplet=x86_64-linux-gnu ;;
  arm64) triplet=aarch64-linux-gnu ;;
  *) skip "no packages for $architecture" ;;
esac
libraries=$folder/root/usr/lib/$triplet
driver=$libraries/libvulkan_lvp.so
manifest=$folder/lavapipe.json

# The system's own driver will do: its manifest, or nothing.
installed=$(dpkg-query -W -f='${db:Status-Status} ${Version}' mesa-vulkan-drivers 2>/dev/null)
if [ "${installed%% *}" = installed ] && dpkg --compare-versions "${installed#* }" ge 25; then
  libraries=
  for manifest in /usr/share/vulkan/icd.d/lvp_icd*.json; do :; done
fi

fetch() {
  [ -e "$keys" ] || skip "no keys of Debian's archive in $keys"
  mkdir -p "$folder/apt/lists/partial" "$folder/apt/cache/archives/partial" "$folder/packages"
  for name in "${suite%-*}" "$suite"; do
    echo "deb [signed-by=$keys] http://deb.debian.org/debian $name main"
  done >"$folder/apt/sources.list"
  # apt's own lists, sources and cache are neither used nor changed.
  set -- -qq -o Dir::Etc::sourcelist="$folder/apt/sources.list" -o Dir::Etc::sourceparts=- \
    -o Dir::State::lists="$folder/apt/lists" -o Dir::Cache="$folder/apt/cache" \
    -o Acquire::Languages=none -o Acquire::Retries=2 -o Acquire::http::Timeout=20 \
    -o APT::Sandbox::User=root -o APT::Update::Error-Mode=any
  apt-get "$@" update >"$folder/apt/log" 2>&1 || skip "$suite cannot be reached ($folder/apt/log)"
  # The driver and what it needs beyond the packages that the system has.
  packages=$(apt-get "$@" --simulate --no-install-recommends -t "$suite" install \
    mesa-vulkan-drivers 2>>"$folder/apt/log" | sed -n 's/^Inst \([^ ]*\) [^(]*(\([^ ]*\) .*/\1=\2/p' |
    grep -E '^(mesa-vulkan-drivers|lib(drm|llvm|display|x|wayland|elf|expat|zstd|vulkan)[^=]*)=' |
    grep -v -e '-dev=' | grep -v '^libdrm-\(intel\|nouveau\|radeon\|tests\)')
  case $packages in
    *mesa-vulkan-drivers=*) ;;
    *) skip "$suite has no driver that can be unpacked here ($folder/apt/log)" ;;
  esac
  # One word a package.
  (cd "$folder/packages" && apt-get "$@" download $packages >>"$folder/apt/log" 2>&1) ||
    skip "packages of $suite cannot be fetched ($folder/apt/log)"
  for package in "$folder"/packages/*.deb; do
    dpkg-deb -x "$package" "$folder/root" || skip "$package cannot be unpacked"
  done
  rm -r "$folder/packages" "$folder/apt/lists" "$folder/apt/cache"
}

if [ ! -e "$manifest" ]; then
  fetch
  missing=$(LD_LIBRARY_PATH=$libraries ldd "$driver" 2>&1 | grep 'not found')
  [ -z "$missing" ] || skip "$(echo "$missing" | head -n 1 | sed 's/^[[:space:]]*//')"
  # The distribution's names the driver by its file alone.
  sed "s|\"library_path\": *\"[^\"]*\"|\"library_path\": \"$driver\"|" \
    "$folder"/root/usr/share/vulkan/icd.d/lvp_icd.*json >"$manifest.new" &&
    mv "$manifest.new" "$manifest"
fi
if [ $# -gt 0 ]; then
  VK_ICD_FILENAMES=$manifest
  [ -z "$libraries" ] || LD_LIBRARY_PATH=$libraries${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
  export VK_ICD_FILENAMES
  [ -z "$libraries" ] || export LD_LIBRARY_PATH
  unset VK_DRIVER_FILES # would be preferred
  exec "$@"
fi
echo "unset VK_DRIVER_FILES"
echo "export VK_ICD_FILENAMES='$manifest'"
[ -z "$libraries" ] || echo "export LD_LIBRARY_PATH='$libraries'\${LD_LIBRARY_PATH:+:\$LD_LIBRARY_PATH}"
