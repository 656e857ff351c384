//! Saving never replaces a file by one that could not be loaded.

use geometry::Mesh;
use swanilda::scene::shape::Shape;
use swanilda::scene::{Data, Kind};
use swanilda::{Options, Simulator};

#[test]
fn what_could_not_be_loaded_again_replaces_no_file() {
    let mut sim = Simulator::new(Options::default());
    let corners = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let mut mesh = Mesh::new(corners, vec![[0, 1, 2]]).unwrap();
    mesh.vertices[0][0] = 1e39;
    let shape = Shape::from_mesh(mesh, Shape::mesh_appearance()).unwrap();
    sim.scene_mut()
        .add("shape", Kind::Shape(Box::new(shape)))
        .unwrap();
    let folder = tempfile::tempdir().unwrap();
    for name in ["scene.ttt", "scene.simscene.xml"] {
        let path = folder.path().join(name);
        std::fs::write(&path, "old").unwrap();
        let name = Data::text(path.to_str().unwrap());
        let error = sim
            .call_api("sim.saveScene", &[name])
            .unwrap_err()
            .to_string();
        assert!(
            error.contains("could not be loaded again") && error.contains("not finite"),
            "{error}"
        );
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
    }
}
