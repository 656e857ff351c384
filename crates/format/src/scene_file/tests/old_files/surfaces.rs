//! Switches, materials and images of shapes.

use super::shapes::{cube, shape, simple};
use super::{file, loaded, object, one_of};
use crate::ttt::chunks::{
    Material as MaterialChunk, MeshData, MeshNode, Shape as Chunk, Texture as TextureChunk,
    TextureMapping as Mapping,
};
use crate::ttt::tree::{Class, Contents};
use crate::ttt::{EngineBlock, Rest};
use scene::appearance::texture_mapping::{ApplyMode, MappingMode, TextureSource};

#[test]
fn switches_of_shapes() {
    let dynamics = |first, third, second| {
        let chunk = Chunk {
            switches: Some(first),
            switches_2: second,
            switches_3: third,
            ..simple(MeshNode::default(), cube())
        };
        let d = shape(chunk).dynamics;
        [
            d.is_static,
            d.kinematic,
            d.start_asleep,
            d.respondable,
            d.dynamic_when_parented,
        ]
    };
    assert_eq!(
        dynamics(0, Some(0), None),
        [true, true, false, false, false]
    );
    assert_eq!(
        dynamics(0x80, Some(0x1), None),
        [false, true, false, true, false]
    );
    assert_eq!(
        dynamics(0x42, Some(0x20), None),
        [true, false, true, false, true]
    );
    assert_eq!(
        dynamics(0x3d, Some(0xde), Some(1)),
        [true, true, false, false, false]
    );
    assert_eq!(dynamics(0, None, Some(1)), [true, true, false, true, false]);
    let switched = |switches| {
        let data = MeshData {
            switches: Some(switches),
            ..cube()
        };
        let appearance = shape(simple(MeshNode::default(), data)).parts[0]
            .appearance
            .clone();
        [
            appearance.edges,
            appearance.culling,
            appearance.wireframe,
            appearance.edge_borders_hidden,
        ]
    };
    assert_eq!(switched(0x1), [true, false, false, false]);
    assert_eq!(switched(0x2), [false, true, false, false]);
    assert_eq!(switched(0x4), [false, false, true, false]);
    assert_eq!(
        [switched(0x80), switched(0x78)],
        [[false, false, false, true], [false; 4]]
    );
    let angles = |shading, edge_threshold_angle| {
        let data = MeshData {
            shading,
            edge_threshold_angle,
            ..cube()
        };
        let appearance = shape(simple(MeshNode::default(), data)).parts[0]
            .appearance
            .clone();
        (appearance.shading_angle, appearance.edge_angle)
    };
    assert_eq!(
        [
            angles(Some((0.25, 1)), None),
            angles(Some((0.25, 1)), Some(0.5))
        ],
        [(0.25, 0.25), (0.25, 0.5)]
    );
}

/// Friction, restitution and the dampings of a shape of a file of that version.
fn material(version: u16, chunk: Option<MaterialChunk>, node: MeshNode, switches: u8) -> [f64; 4] {
    let chunk = Chunk {
        material: chunk,
        switches: Some(switches),
        ..simple(node, cube())
    };
    let named = MaterialChunk {
        bul: Some([0.5, 0.625, 0.25, 0.125, 0.0, 0.0]),
        id: Some(7),
        ..MaterialChunk::default()
    };
    let contents = Contents {
        objects: vec![object(1, -1, Class::Shape(Box::new(chunk)))],
        materials: vec![
            MaterialChunk {
                id: Some(6),
                ..MaterialChunk::default()
            },
            named,
        ],
        ..Contents::default()
    };
    let (scene, made) = loaded(file(version, 19, contents));
    let material = &scene
        .object(made.objects[0])
        .unwrap()
        .shape()
        .unwrap()
        .material;
    [
        material.friction,
        material.restitution,
        material.linear_damping,
        material.angular_damping,
    ]
}

#[test]
fn materials_were_named_before_shapes_had_their_own() {
    let named = || MeshNode {
        dyn_material_id: Some(7),
        ..MeshNode::default()
    };
    let reals = vec![0.75, 1.0, 0.5, 0.375, 0.0625];
    let bullet = EngineBlock {
        reals,
        ints: Vec::new(),
    };
    let own = || {
        Some(MaterialChunk {
            bullet: Some(bullet.clone()),
            ..MaterialChunk::default()
        })
    };
    let (of_file, of_shape) = ([0.625, 0.5, 0.25, 0.125], [1.0, 0.75, 0.375, 0.0625]);
    assert_eq!(material(30_302, own(), named(), 0), of_file);
    assert_eq!(material(30_303, own(), named(), 0), of_shape);
    assert_eq!(material(30_302, own(), MeshNode::default(), 0), of_shape);
    assert_eq!(material(30_303, None, named(), 0), of_file);
    let oldest = MeshNode {
        bul_v16: Some([0.5, 0.25, 0.125, 0.0625, 0.0]),
        ..MeshNode::default()
    };
    assert_eq!(
        material(30_001, None, oldest, 0),
        [0.25, 0.5, 0.125, 0.0625]
    );
}

#[test]
fn sticky_materials_had_little_friction_where_they_moved() {
    let friction = |version, mvar, switches| {
        let chunk = MaterialChunk {
            bul: Some([0.0, 1.0, 0.0, 0.0, 0.0, 0.0]),
            mvar: Some(mvar),
            ..MaterialChunk::default()
        };
        let chunk = Chunk {
            material: Some(chunk),
            switches: Some(switches),
            ..simple(MeshNode::default(), cube())
        };
        let object = one_of(version, 18, object(1, -1, Class::Shape(Box::new(chunk))));
        let material = object.shape().unwrap().material.clone();
        scene::parameters::engine_blocks::EngineValues::number(&material, 6003)
    };
    assert_eq!(friction(30_300, 0x2, 0x80), Some(0.25));
    assert_eq!(friction(30_300, 0x2, 0), Some(1.0));
    assert_eq!(
        [friction(30_300, 0xfd, 0x80), friction(30_301, 0x2, 0x80)],
        [Some(1.0); 2]
    );
}

#[test]
fn images_and_their_mapping() {
    let mapping = |source, old_flags, flags, apply_mode| Mapping {
        source: Some(([source, 3], [2.0, 0.5])),
        old_flags: Some(old_flags),
        flags,
        apply_mode,
        ..Mapping::default()
    };
    let textured = |mapping| {
        let data = MeshData {
            texture: Some(mapping),
            ..cube()
        };
        Class::Shape(Box::new(simple(MeshNode::default(), data)))
    };
    let image = |id, pixels: &[u8], flags| TextureChunk {
        id_and_size: Some([id, 1, 1]),
        flags: Some(flags),
        pixels: Some(Rest(pixels.to_vec())),
        ..TextureChunk::default()
    };
    let contents = Contents {
        objects: vec![
            object(999_999, -1, Class::VisionSensor(Box::default())),
            object(1, -1, textured(mapping(1_000_000, 0xf, None, None))),
            object(2, -1, textured(mapping(999_999, 0xf, Some(0x4), Some(0)))),
            object(3, -1, textured(mapping(1_000_001, 0, None, None))),
            object(4, -1, textured(mapping(77, 0, None, None))),
        ],
        // The second one lacks pixels.
        textures: vec![
            image(1_000_000, &[1, 2, 3, 4], 1),
            image(1_000_001, &[1], 0),
        ],
        ..Contents::default()
    };
    let (scene, made) = loaded(file(40_100, 22, contents));
    let texture = |at: usize| {
        let shape = scene.object(made.objects[at]).unwrap().shape().unwrap();
        shape.parts[0].texture.clone()
    };
    let (first, second) = (texture(1).unwrap(), texture(2).unwrap());
    let TextureSource::Texture(id) = first.source else {
        panic!("no image")
    };
    assert!(scene.textures().get(id).unwrap().has_alpha());
    assert_eq!(second.source, TextureSource::Sensor(made.objects[0]));
    assert_eq!(
        (first.interpolate, first.repeat, first.apply_mode),
        (true, [true; 2], ApplyMode::DECAL)
    );
    assert_eq!(
        (second.interpolate, second.repeat, second.apply_mode),
        (false, [true, false], ApplyMode::MODULATE)
    );
    assert_eq!((first.mode, first.scale), (MappingMode(3), [2.0, 0.5]));
    assert!(texture(3).is_none() && texture(4).is_none());
}
