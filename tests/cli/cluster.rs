//! The examples for many machines: parts of a sweep, run by Slurm or Snakemake, merge to the rows of an
//! undivided sweep.

use super::sweep::counts;
use crate::support::program::Program;
use std::path::{Path, PathBuf};
use std::process::Command;

const SWEEP: &str =
    "tetra:2 --d-max 3..5,auto --n-oilf 1,2 --method midpoint,bvh-sweep --resolution 16x12";

/// Stands in for Slurm: runs the jobs of an array one after the other, and a job that depends on it at once.
const SBATCH: &str = r#"#!/usr/bin/env bash
set -euo pipefail
echo "sbatch $*" >> calls.txt
array=
while [[ $1 == --* ]]; do
    case $1 in --array=1-*) array=${1#--array=1-} ;; esac
    shift
done
if [ -n "$array" ]; then
    for ((i = 1; i <= array; i++)); do
        SLURM_ARRAY_TASK_ID=$i SLURM_ARRAY_TASK_COUNT=$array bash "$@" > /dev/null
    done
    echo "17;main"
else
    bash "$@"
fi
"#;

fn example(name: &str) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    root.join("examples/cluster").join(name)
}

/// Returns a command in the folder of the program, which finds it and the stub of Slurm.
fn with_path(program: &Program, name: &str) -> Command {
    let tools = program.file("tools");
    if !tools.exists() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        std::fs::create_dir(&tools).unwrap();
        symlink(env!("CARGO_BIN_EXE_bspscope"), tools.join("bspscope")).unwrap();
        let sbatch = tools.join("sbatch");
        std::fs::write(&sbatch, SBATCH).unwrap();
        std::fs::set_permissions(&sbatch, PermissionsExt::from_mode(0o755)).unwrap();
    }
    let known = std::env::var_os("PATH").unwrap_or_default();
    let path = std::iter::once(tools).chain(std::env::split_paths(&known));
    let mut command = Command::new(name);
    command
        .current_dir(program.path())
        .env("PATH", std::env::join_paths(path).unwrap());
    command
}

/// Runs a command that must succeed.
fn succeeds(command: &mut Command) -> String {
    let output = command.output().unwrap();
    let text = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
    assert!(output.status.success(), "{command:?}: {text}");
    text
}

fn assert_whole(program: &Program) {
    program.ends(0, &format!("sweep {SWEEP} -o whole.csv"));
    let whole = counts(program, "whole.csv");
    assert_eq!(whole.len(), 16);
    assert_eq!(counts(program, "rows.csv"), whole);
}

#[test]
fn a_slurm_array_merges_to_the_undivided_sweep() {
    let program = Program::new();
    let mut submit = with_path(&program, "bash");
    submit.arg(example("submit.sh")).arg("3");
    submit.args(SWEEP.split_whitespace());
    submit.env("SBATCH_OPTIONS", "--partition=long --time=10");
    succeeds(&mut submit);
    assert_whole(&program);
    let calls = program.read("calls.txt");
    let [array, merge]: [&str; 2] = calls.lines().collect::<Vec<_>>().try_into().unwrap();
    assert!(
        array.contains("--partition=long --time=10 --array=1-3"),
        "{array}"
    );
    assert!(
        merge.contains("--partition=long --time=10 --dependency=afterok:17 "),
        "{merge}"
    );
    let usage = with_path(&program, "bash")
        .arg(example("submit.sh"))
        .output()
        .unwrap();
    assert_eq!(usage.status.code(), Some(2));
    let usage = String::from_utf8(usage.stdout).unwrap();
    assert!(usage.starts_with("Submits a sweep to Slurm"), "{usage}");
}

#[test]
fn two_jobs_of_snakemake_merge_to_the_undivided_sweep() {
    let program = Program::new();
    if with_path(&program, "snakemake")
        .arg("--version")
        .output()
        .is_err()
    {
        println!("snakemake is not installed: skipped");
        return;
    }
    let mut snakemake = with_path(&program, "snakemake");
    snakemake
        .args(["--cores", "2", "--snakefile"])
        .arg(example("Snakefile"));
    snakemake.args(["--config", "parts=2", &format!("sweep={SWEEP}")]);
    // Its caches stay in this folder.
    snakemake
        .env("HOME", program.path())
        .env("XDG_CACHE_HOME", program.path());
    let text = succeeds(&mut snakemake);
    assert!(text.contains("3 of 3 steps (100%) done"), "{text}");
    assert_whole(&program);
}
