//! Closed meshes leak no ray.

mod closed_meshes;

#[test]
fn no_ray_at_an_edge_or_vertex_leaves_a_closed_mesh() {
    let found = closed_meshes::leaks(1_000_000);
    assert!(found.len() >= 12);
    assert!(found.iter().map(|(_, rays, _)| rays).sum::<u64>() >= 1_000_000);
    for (mesh, rays, leaks) in found {
        assert_eq!(leaks, 0, "{mesh}: of {rays} rays");
    }
}
