#!/usr/bin/env bash
# Submits a sweep to Slurm: an array of PARTS jobs, and a job that merges their rows into rows.csv.
#
#   bash submit.sh PARTS SCENE [OPTIONS OF bspscope sweep]
#   bash submit.sh 8 balls --d-max 8..24 --method midpoint,sah,bvh-sweep
#
# Run it in the folder that shall have the rows; all nodes must see this folder and find bspscope.
# Options of sbatch, such as a partition or the kind of processor, go into SBATCH_OPTIONS.
set -euo pipefail
[ $# -ge 2 ] || { sed -n '2,8s/^# \{0,1\}//p' "$0"; exit 2; }
scripts=$(cd "$(dirname "$0")" && pwd)
parts=$1
shift
mkdir -p parts
read -ra options <<< "${SBATCH_OPTIONS:-}"
array=$(sbatch --parsable "${options[@]}" --array="1-$parts" "$scripts/part.slurm" "$@")
# With a cluster's name, the answer is ID;CLUSTER.
sbatch --parsable "${options[@]}" --dependency="afterok:${array%%;*}" "$scripts/merge.slurm" "$parts"
