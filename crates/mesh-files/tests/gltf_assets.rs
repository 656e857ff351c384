//! Nodes of glTF files: what is written is read again, and what others write is read as they mean it.

use std::f64::consts::FRAC_PI_2;

use mesh_files::gltf::{Animation, Asset, Camera, Extent, Light, LightKind, Node, Track};
use mesh_files::{Limits, Material, Part, Texture, WriteError};

fn triangle(material: Material) -> Part {
    Part {
        vertices: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        triangles: vec![[0, 1, 2]],
        normals: vec![[[0.0, 0.0, 1.0]; 3]],
        uv: vec![[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]],
        material,
        ..Part::default()
    }
}

/// A turned base with an arm that swings, a camera and lights.
fn example() -> Asset {
    let paint = Material {
        diffuse: Some([1.0, 0.5, 0.25]),
        texture: Some(0),
        double_sided: true,
        ..Material::default()
    };
    let glass = Material {
        diffuse: Some([0.0, 0.0, 1.0]),
        transparency: 0.75,
        ..Material::default()
    };
    let named = |name: &str, parent| Node {
        name: name.into(),
        parent,
        ..Node::default()
    };
    let camera = |extent| {
        Some(Camera {
            extent,
            aspect_ratio: 1.5,
            clipping: [0.125, 100.0],
        })
    };
    let light = |kind| {
        Some(Light {
            kind,
            color: [1.0, 0.5, 0.25],
            intensity: 2.0,
        })
    };
    Asset {
        nodes: vec![
            Node {
                translation: [1.0, 2.0, 3.0],
                rotation: [0.0, 0.6, 0.0, 0.8],
                mesh: Some(0),
                ..named("base \"0\"", None)
            },
            Node {
                translation: [0.0, 0.5, 0.0],
                mesh: Some(1),
                ..named("arm", Some(0))
            },
            Node {
                camera: camera(Extent::Angle(0.75)),
                rotation: [0.6, 0.0, 0.0, 0.8],
                ..named("eye", Some(1))
            },
            Node {
                camera: camera(Extent::Height(4.0)),
                ..named("plan", None)
            },
            Node {
                light: light(LightKind::Spot(0.5)),
                ..named("spot", None)
            },
            Node {
                light: light(LightKind::Point),
                ..named("bulb", Some(4))
            },
            Node {
                light: light(LightKind::Directional),
                ..named("", Some(4))
            },
        ],
        meshes: vec![
            vec![triangle(paint.clone()), triangle(glass)],
            vec![triangle(paint)],
        ],
        textures: vec![Texture {
            name: "grain.png".into(),
            bytes: b"\x89PNG...".to_vec(),
        }],
        ..Asset::default()
    }
}

fn read(bytes: &[u8]) -> Asset {
    Asset::read(bytes, Limits::default(), &mut |name| {
        Err(format!("{name} is not there"))
    })
    .expect("a sound file")
}

#[test]
fn what_is_written_is_read_in_both_forms() {
    let example = example();
    for bytes in [
        example.to_binary().expect("sound"),
        example.to_text().expect("sound").into_bytes(),
    ] {
        let again = read(&bytes);
        for (node, expected) in again.nodes.iter().zip(&example.nodes) {
            let numbers = |node: &Node| [&node.translation[..], &node.rotation].concat();
            assert!(
                numbers(node)
                    .iter()
                    .zip(numbers(expected))
                    .all(|(a, b)| (a - b).abs() < 1e-15),
                "{node:?}"
            );
            let looks = |node: &Node| Node {
                translation: [0.0; 3],
                rotation: [0.0; 4],
                ..node.clone()
            };
            assert_eq!(looks(node), looks(expected));
        }
        assert_eq!(
            (again.nodes.len(), &again.meshes, &again.textures),
            (7, &example.meshes, &example.textures)
        );
        assert!(again.warnings.is_empty());
    }
}

#[test]
fn animations_are_written_where_something_moves() {
    let mut asset = example();
    let track = Track {
        node: 1,
        times: vec![0.0, 0.5, 1.0],
        translations: Vec::new(),
        rotations: vec![
            [0.0, 0.0, 0.0, 1.0],
            [0.0, 0.6, 0.0, 0.8],
            [0.0, 1.0, 0.0, 0.0],
        ],
    };
    asset.animations = vec![
        Animation {
            name: "swing".into(),
            tracks: vec![track],
        },
        Animation::default(),
    ];
    let document: serde_json::Value =
        serde_json::from_str(&asset.to_text().expect("sound")).expect("JSON");
    let animations = document["animations"].as_array().expect("a list");
    assert_eq!(animations.len(), 1, "one without channels is not allowed");
    assert_eq!(
        animations[0]["channels"][0]["target"],
        serde_json::json!({ "node": 1, "path": "rotation" })
    );
    let times = &document["accessors"][animations[0]["samplers"][0]["input"]
        .as_u64()
        .expect("an index") as usize];
    assert_eq!(
        (&times["min"][0], &times["max"][0], &times["count"]),
        (&0.0.into(), &1.0.into(), &3.into())
    );
    assert_eq!(
        read(&asset.to_binary().expect("sound")).warnings,
        ["animations are left out"]
    );
}

#[test]
fn corners_that_are_alike_share_a_vertex() {
    let square = Part {
        vertices: vec![
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
        ],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        normals: vec![[[0.0, 0.0, 1.0]; 3], [[0.0, 0.0, 1.0]; 3]],
        ..Part::default()
    };
    let node = Node {
        mesh: Some(0),
        ..Node::default()
    };
    let asset = Asset {
        nodes: vec![node],
        meshes: vec![vec![square]],
        ..Asset::default()
    };
    assert_eq!(
        read(&asset.to_binary().expect("sound")).meshes[0][0]
            .vertices
            .len(),
        4
    );
}

#[test]
fn scales_become_part_of_the_meshes() {
    let text = br#"{"asset":{"version":"2.0"},"nodes":[
        {"matrix":[0,2,0,0, -2,0,0,0, 0,0,2,0, 5,6,7,1],"children":[1]},
        {"translation":[1,0,0],"scale":[1,1,-1],"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
        "bufferViews":[{"buffer":0,"byteLength":36}],
        "buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAIA/"}]}"#;
    let asset = read(text);
    let close = |a: &[f64], b: &[f64]| {
        assert!(
            a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12),
            "{a:?} is not {b:?}"
        );
    };
    close(&asset.nodes[0].translation, &[5.0, 6.0, 7.0]);
    close(
        &asset.nodes[0].rotation,
        &[0.0, 0.0, 0.5_f64.sqrt(), 0.5_f64.sqrt()],
    );
    close(&asset.nodes[1].translation, &[2.0, 0.0, 0.0]);
    let part = &asset.meshes[0][0];
    close(
        part.vertices.as_flattened(),
        &[0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 2.0, -2.0],
    );
    assert_eq!(part.triangles, [[0, 2, 1]], "a mirror turns triangles over");
    let angle = |node: &Node| 2.0 * node.rotation[2].atan2(node.rotation[3]);
    close(&[angle(&asset.nodes[0])], &[FRAC_PI_2]);
}

#[test]
fn nodes_without_their_mesh_or_parent_are_not_written() {
    let wrong = [
        Node {
            mesh: Some(2),
            ..Node::default()
        },
        Node {
            parent: Some(0),
            ..Node::default()
        },
        Node {
            translation: [f64::NAN, 0.0, 0.0],
            ..Node::default()
        },
    ];
    for node in wrong {
        let asset = Asset {
            nodes: vec![node],
            ..Asset::default()
        };
        assert_eq!(asset.to_binary(), Err(WriteError::NoSuchNode { node: 0 }));
    }
}

#[test]
fn damaged_files_are_read_or_refused() {
    let sample = example().to_text().expect("sound").into_bytes();
    let limits = Limits {
        vertices: 1000,
        triangles: 1000,
        parts: 100,
    };
    let try_to_read = |bytes: &[u8]| {
        let Ok(asset) = Asset::read(bytes, limits, &mut |_| Err(String::new())) else {
            return;
        };
        asset.to_binary().expect("what was read is sound");
    };
    for at in 0..sample.len() {
        try_to_read(&sample[..at]);
        for value in [b' ', b'-', b'9', b'[', b'"', 0xff] {
            let mut changed = sample.clone();
            changed[at] = value;
            try_to_read(&changed);
        }
    }
}
