//! Closed meshes leak no ray: rays from inside at vertices and edges, each of which must hit.
//!
//! `cargo bench --bench leaks -- [RAYS]`, 10⁸ without a number. Prints how many left each mesh.

#[path = "../tests/support"]
#[allow(dead_code)] // The tests use the rest.
mod support {
    pub mod closed_meshes;
    pub mod random;
    pub mod scenes;
}

use std::time::Instant;
use support::closed_meshes;

fn main() {
    let count = std::env::args().skip(1).find_map(|arg| arg.parse().ok());
    let count: u64 = count.unwrap_or(100_000_000);
    let start = Instant::now();
    let mut leaked = 0;
    for mesh in closed_meshes::leaks(count) {
        println!("{}: {} rays, {} leaked", mesh.name, mesh.rays, mesh.leaked);
        if let Some(ray) = mesh.example {
            println!("  such as {ray:?}");
        }
        leaked += mesh.leaked;
    }
    println!("{:.0} s", start.elapsed().as_secs_f64());
    assert_eq!(leaked, 0);
}
