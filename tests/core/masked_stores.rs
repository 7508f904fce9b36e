//! The machine code of the AVX2 kernels.

use std::process::Command;

fn output(program: &str, arguments: &[&str]) -> String {
    let output = Command::new(program).args(arguments).output();
    let output = output.unwrap_or_else(|error| panic!("{program} (Debian: binutils): {error}"));
    assert!(output.status.success(), "{program} failed");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// The AVX2 kernels have no masked vector stores, which Zen 2 and Zen 3 execute as microcode. The compiler makes
/// them of "load, select, store".
#[test]
fn avx2_kernels_store_whole_vectors() {
    let program = std::env::current_exe().unwrap();
    let program = program.to_str().unwrap();
    let symbols = output("nm", &["--defined-only", "--print-size", program]);
    let kernels: Vec<[u64; 2]> = symbols
        .lines()
        .filter(|line| line.contains("compiled") && line.contains("_avx2"))
        .map(|line| {
            let number = |k| u64::from_str_radix(line.split(' ').nth(k).unwrap(), 16).unwrap();
            [number(0), number(1)]
        })
        .collect();
    assert!(kernels.len() >= 9, "{} kernels", kernels.len());
    for [start, size] in kernels {
        let range = [
            format!("--start-address={start}"),
            format!("--stop-address={}", start + size),
        ];
        let code = output("objdump", &["-d", &range[0], &range[1], program]);
        assert!(code.contains("%ymm"), "no kernel at {start:x}");
        let masked = code
            .lines()
            .filter(|l| l.contains("vmaskmov") || l.contains("vpmaskmov"));
        assert_eq!(masked.collect::<Vec<_>>(), [""; 0]);
    }
}
