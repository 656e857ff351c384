//! Shapes, images and graphs none of whose settings is as it is by default come back from files.

use super::everything::{COLOUR, add, dummy, returned, vision_sensor};
use std::rc::Rc;

use super::super::Loaded;
use super::{load, saved};
use geometry::{Mesh, PrimitiveKind};
use scene::appearance::texture::Texture;
use scene::appearance::texture_mapping::{ApplyMode, MappingMode, TextureMapping, TextureSource};
use scene::graph::{
    CurveStyle, Graph, GraphCurve, GraphSample, GraphStream, OldSource, Transformation,
    TransformationKind,
};
use scene::shape::{RespondableMask, Shape, ShapeDynamics, Velocity};
use scene::{Handle, Kind, Pose, Scene};

fn style(id: i64, is_on: bool) -> CurveStyle {
    CurveStyle {
        id,
        name: format!("curve {id}"),
        unit: "m".into(),
        colour: [0.25, 0.5, 0.75],
        label: is_on,
        linked: !is_on,
    }
}

fn stream(id: i64, is_on: bool) -> GraphStream {
    let sample = |raw, transformed| GraphSample { raw, transformed };
    GraphStream {
        visible: is_on,
        transformation: Transformation {
            kind: TransformationKind::Integral,
            multiplier: 2.0,
            offset: 0.5,
            period: 3,
            cyclic_range: 0.0,
        },
        samples: [sample(None, Some(3.0)), sample(Some(4.0), None)].into(),
        ..GraphStream::new(style(id, is_on))
    }
}

#[test]
fn graphs_with_recordings_of_both_kinds() {
    let mut scene = Scene::new();
    let object = Some(dummy(&mut scene));
    let (data_type, auxiliary) = (5, 6);
    let source = Some(OldSource {
        data_type,
        object,
        auxiliary,
    });
    let unit = String::new();
    let mut old = GraphStream {
        source,
        ..stream(2, false)
    };
    old.style.unit.clone_from(&unit);
    let mut new = stream(0, true);
    new.transformation.cyclic_range = 6.25;
    let fixed = GraphStream {
        samples: Default::default(),
        fixed: Some(vec![[0.0, 1.0], [0.5, 2.0]]),
        ..stream(1, true)
    };
    let curve = |id: i64, dimensions: usize, old: bool| GraphCurve {
        style: CurveStyle {
            unit: if old { unit.clone() } else { "m".into() },
            ..style(id, true)
        },
        width: 3,
        dimensions,
        streams: [0, 1, if dimensions == 3 { 2 } else { -1 }],
        defaults: if old { [0.0; 3] } else { [0.25, 0.5, 0.75] },
        relative: dimensions == 3,
        fixed: None,
        old,
    };
    let mut points = curve(5, 3, false);
    points.fixed = Some(vec![[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    let mut graph = Graph::default();
    (graph.explicit, graph.cyclic, graph.buffer_size) = (true, false, 77);
    (graph.size, graph.background, graph.foreground) = (0.5, [0.25; 3], [0.5; 3]);
    let curves = vec![
        curve(3, 2, false),
        curve(4, 3, false),
        points,
        curve(6, 3, true),
        curve(7, 2, true),
    ];
    graph.restore([0.5, 0.75].into(), vec![new, fixed, old], curves);
    add(&mut scene, Kind::Graph(Box::new(graph)));
    returned(&scene);
}

#[test]
fn samples_of_a_stream_that_came_later_are_the_last_ones() {
    let mut graph = Graph::default();
    graph.restore([0.0, 0.5].into(), vec![stream(0, true)], Vec::new());
    graph.streams_mut()[0].samples.pop_front();
    let mut scene = Scene::new();
    let handle = add(&mut scene, Kind::Graph(Box::new(graph)));
    let (again, loaded) = load(&saved(&scene, &Loaded::default()));
    let of = |scene: &Scene, handle: Handle| match &scene.object(handle).unwrap().kind {
        Kind::Graph(graph) => graph.streams()[0].samples.clone(),
        _ => panic!("no graph"),
    };
    let (before, after) = (of(&scene, handle), of(&again, loaded.objects[0]));
    assert_eq!(after.len(), 2);
    assert_eq!(after[0], GraphSample::default());
    assert!(after.iter().skip(1).eq(&before));
}

fn cuboid() -> Shape {
    Shape::primitive(PrimitiveKind::Cuboid, [0.25, 0.5, 1.0], Default::default()).unwrap()
}

fn on_shape(scene: &mut Scene, shape: Shape) -> Handle {
    add(scene, Kind::Shape(Box::new(shape)))
}

#[test]
fn shapes_with_all_switches() {
    let mut scene = Scene::new();
    for on in [true, false] {
        let mut shape = cuboid();
        let (linear, angular) = ([1.0, 2.0, 3.0], [4.0, 5.0, 6.0]);
        shape.dynamics = ShapeDynamics {
            is_static: on,
            respondable: !on,
            kinematic: on,
            start_asleep: !on,
            dynamic_when_parented: on,
            respondable_mask: RespondableMask(0x0ff0),
            respondable_suspend_count: 0,
            initial_velocity: Velocity { linear, angular },
        };
        (shape.material.friction, shape.material.restitution) = (0.25, 0.5);
        shape.mass.set_mass(3.0);
        let part = &mut shape.parts[0];
        part.mass = shape.mass;
        let appearance = &mut part.appearance;
        (appearance.edges, appearance.culling, appearance.wireframe) = (on, !on, on);
        appearance.edge_borders_hidden = !on;
        (appearance.shading_angle, appearance.edge_angle) = (0.25, 0.75);
        (appearance.colour, appearance.colour_name) = (COLOUR, "paint".into());
        appearance.colour_extension = "openGL3 {}".into();
        on_shape(&mut scene, shape);
    }
    returned(&scene);
}

#[test]
fn terrains_and_meshes_beside_their_frame() {
    let mut scene = Scene::new();
    let heights = [0.0, 0.5, 0.25, 0.125, 1.0, 0.75];
    let appearance = Shape::terrain_appearance();
    on_shape(
        &mut scene,
        Shape::terrain(3, 2, 2.0, &heights, appearance, false).unwrap(),
    );
    let corners = [
        [1.0, 2.0, 3.0],
        [2.0, 2.0, 3.0],
        [1.0, 4.0, 3.0],
        [1.0, 2.0, 4.0],
    ];
    let triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let mesh = Mesh::new(corners.to_vec(), triangles).unwrap();
    let shape = Shape::from_mesh(mesh, Shape::mesh_appearance()).unwrap();
    let handle = on_shape(&mut scene, shape);
    let again = returned(&scene);
    // Vertices are kept beside their box, in single precision.
    let [before, after] = [&scene, &again].map(|scene| {
        let shape = scene.object(handle).unwrap().shape().unwrap();
        let part = &shape.parts[0];
        let at = |v: &[f64; 3]| part.pose * nalgebra::Point3::from(*v);
        part.mesh.vertices.iter().map(at).collect::<Vec<_>>()
    });
    assert!(
        before
            .iter()
            .zip(&after)
            .all(|(a, b)| (a - b).norm() < 1e-6)
    );
}

#[test]
fn images_on_shapes() {
    let mut scene = Scene::new();
    let pixels = [1, 2, 3, 4, 5, 6, 7, 8];
    let image = Texture::new("stripes", [2, 1], true, &pixels).unwrap();
    let image = scene.textures_mut().add(image).unwrap();
    let sensor = Kind::VisionSensor(Box::new(vision_sensor(true)));
    let sensor = add(&mut scene, sensor);
    let corners = 6 * cuboid().parts[0].mesh.triangles.len();
    let sources = [TextureSource::Texture(image), TextureSource::Sensor(sensor)];
    for (source, on) in sources.into_iter().zip([true, false]) {
        let coordinates: Vec<f32> = (0..corners).map(|at| at as f32 / 8.0).collect();
        let mapping = TextureMapping {
            source,
            mode: MappingMode::SPHERE,
            scale: [2.0, 0.5],
            frame: Pose::new([1.0, 2.0, 3.0].into(), [0.1, 0.2, 0.3].into()),
            interpolate: on,
            repeat: [on, !on],
            apply_mode: ApplyMode::decal_if(on),
            coordinates: if on {
                coordinates.into()
            } else {
                Rc::default()
            },
        };
        let mut shape = cuboid();
        shape.parts[0].texture = Some(Box::new(mapping));
        on_shape(&mut scene, shape);
    }
    returned(&scene);
}
