//! Closed meshes leak no ray.

#[test]
fn no_ray_at_an_edge_or_vertex_leaves_a_closed_mesh() {
    let found = crate::support::closed_meshes::leaks(1_000_000);
    assert!(found.len() >= 12);
    assert!(found.iter().map(|mesh| mesh.rays).sum::<u64>() >= 1_000_000);
    let leaks: Vec<_> = found.iter().filter(|mesh| mesh.leaked > 0).collect();
    for mesh in &leaks {
        let (name, example) = (&mesh.name, mesh.example);
        eprintln!(
            "{name}: {} of {} rays, such as {example:?}",
            mesh.leaked, mesh.rays
        );
    }
    assert!(leaks.is_empty());
}
