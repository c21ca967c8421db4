# SPDX-License-Identifier: GPL-3.0-only
# shellcheck shell=bash
# Sourced by ./run and ./test, what both do first: packages, environment, build. All messages go to stderr, so that stdout
# holds the program's output alone.

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
build_dir=$project/build

# One process uses one core: threads of a BLAS only slow down small fronts, and tests run side by side.
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 MKL_NUM_THREADS=1
# Open MPI refuses root, which is what one is in a container.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
# In a container without /sys the topology library complains on stderr.
export HWLOC_HIDE_ERRORS=2

say() { printf '%s\n' "$*" >&2; }

# run_logged LOG WHAT COMMAND...: quiet unless it fails.
run_logged()
{
  local log=$1 what=$2
  shift 2
  "$@" >>"$log" 2>&1 </dev/null && return
  say "$what failed. The last lines of $log:"
  tail -n 40 "$log" >&2
  return 1
}

missing_packages()
{
  # Fails if any package is unknown, which is one of the answers looked for.
  local installed
  installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null) || true
  local package
  for package in "$@"; do
    grep -qxF "installed $package" <<<"$installed" || printf '%s\n' "$package"
  done
}

# Only `thorough` needs those of the last section.
needed_packages() # sprag, all or thorough
{
  if [ "$1" = thorough ]; then cat "$project/packages.txt"; else sed '/^# Thorough$/,$d' "$project/packages.txt"; fi |
    sed 's/#.*//; s/[[:space:]]*$//; /^$/d'
}

install_packages() # sprag, all or thorough
{
  local needed missing
  mapfile -t needed < <(needed_packages "$1")
  if ! command -v dpkg-query >/dev/null; then
    say "This is no Debian system: nothing is installed. Needed is what packages.txt lists."
    return
  fi
  # All were found, and nothing was installed or removed since.
  local found=$build_dir/packages-$1.found
  [ "$found" -nt /var/lib/dpkg/status ] && [ "$found" -nt "$project/packages.txt" ] && return
  mapfile -t missing < <(missing_packages "${needed[@]}")
  if [ "${#missing[@]}" -eq 0 ]; then
    touch "$found"
    return
  fi

  local as_root=(env)
  if [ "$(id -u)" -ne 0 ]; then
    # sudo may ask for a password only where there is somebody to answer.
    if ! command -v sudo >/dev/null || ! { sudo -n true 2>/dev/null || { [ -t 0 ] && [ -t 2 ] && sudo -v; }; }; then
      say "Packages are missing, and only root can install them:"
      say "  apt-get update && apt-get install -y --no-install-recommends ${missing[*]}"
      return 1
    fi
    as_root=(sudo env)
  fi
  as_root+=(DEBIAN_FRONTEND=noninteractive)

  local log=$build_dir/packages.log
  say "Installing ${missing[*]} (log: $log)"
  : >"$log"
  # A package source that does not answer matters only if the packages cannot be had without it.
  "${as_root[@]}" apt-get update >>"$log" 2>&1 </dev/null || say "apt-get update failed, going on with the lists there are."
  run_logged "$log" "Installing packages" \
    "${as_root[@]}" apt-get -o DPkg::Lock::Timeout=300 install -y --no-install-recommends "${missing[@]}"
}

build() # TARGET
{
  local target=$1 log=$build_dir/build.log
  : >"$log"
  # A cache from another place, left by a moved or copied folder, would build that place.
  if [ ! -e "$build_dir/build.ninja" ] || ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$project" "$build_dir/CMakeCache.txt"; then
    (cd "$project" && run_logged "$log" "Configuring" cmake --preset release --fresh) || return
  fi
  # Said only where there is something to wait for.
  [ -e "$build_dir/sprag" ] || say "Building, which takes a few minutes the first time (log: $log)"
  run_logged "$log" "Building" cmake --build "$build_dir" --target "$target"
}

set_up() # sprag, all with the tests, or thorough: the same with packages for all tests
{
  mkdir -p "$build_dir" || return
  # Two at once in one folder would build into each other's files.
  local lock status=0
  exec {lock}>"$build_dir/set-up.lock"
  flock "$lock"
  { install_packages "$1" && build "${1/thorough/all}"; } || status=$?
  exec {lock}>&-
  return "$status"
}
