//! What is written for other programs, older ones among them (spec: scene-files 6, scene-files 7, scene-files 9).

use super::super::save;
use super::everything::{COLOUR, add, dummy, joint, proximity_sensor, returned};
use crate::ttt::chunks::{Joint as JointChunk, Shape as ShapeChunk};
use crate::ttt::tree::{Class, Contents, MeshTree};
use geometry::{MassProperties, PrimitiveKind};
use scene::joint::{Control, JointType};
use scene::parameters::engine::Engine;
use scene::parameters::engine_blocks::EngineValues;
use scene::sensor::volume::VolumeType;
use scene::sensor::volume_faces::VolumeFaces;
use scene::sensor::{Camera, Entity, VisionOptions, VisionSensor};
use scene::shape::Shape;
use scene::{Field, Handle, Kind, ModelFlags, Pose, References, Scene};
use std::f64::consts::TAU;

fn contents(scene: &Scene) -> Contents {
    save::scene(scene, &[]).unwrap().contents
}

/// The chunk of the only object of a scene.
fn chunk(kind: Kind) -> Class {
    let mut scene = Scene::new();
    add(&mut scene, kind);
    contents(&scene).objects.remove(0).class
}

fn joint_chunk(control: Control) -> JointChunk {
    let joint = joint(JointType::Revolute, control);
    let Class::Joint(chunk) = chunk(Kind::Joint(Box::new(joint))) else {
        panic!("no joint")
    };
    *chunk
}

#[test]
fn joints_have_the_switches_of_before_4_3() {
    for (control, switches) in [
        (Control::Free, 0x40),
        (Control::Force, 0x40),
        (Control::Velocity, 0x50),
        (Control::Position, 0x70),
        (Control::Callback, 0x70),
        (Control::Spring, 0xf0),
    ] {
        assert_eq!(joint_chunk(control).switches, Some(switches), "{control:?}");
    }
    let chunk = joint_chunk(Control::Free);
    assert!((chunk.screw_pitch.unwrap() * TAU - 0.75).abs() < 1e-12);
    assert_eq!(chunk.screw_lead, Some(0.75));
}

#[test]
fn parameters_of_engines_come_back() {
    let mut joint = joint(JointType::Revolute, Control::Free);
    let mut shape = cuboid();
    let mut scene = Scene::new();
    let mut settings = scene.settings().clone();
    for engine in Engine::ALL {
        let raised = |values: &mut dyn FnMut(&[f64], &[i32]),
                      (reals, ints): (Vec<f64>, Vec<i32>)| {
            let reals: Vec<f64> = reals.iter().map(|real| real + 0.5).collect();
            values(&reals, &ints);
        };
        let rows = joint.engine_rows(engine);
        raised(
            &mut |reals, ints| joint.load_engine(engine, reals, ints),
            rows,
        );
        let rows = shape.material.engine_rows(engine);
        raised(
            &mut |reals, ints| shape.material.load_engine(engine, reals, ints),
            rows,
        );
        let rows = settings.dynamics.engine_rows(engine);
        raised(
            &mut |reals, ints| settings.dynamics.load_engine(engine, reals, ints),
            rows,
        );
    }
    scene.modify_settings(|kept| *kept = settings);
    add(&mut scene, Kind::Joint(Box::new(joint)));
    add(&mut scene, Kind::Shape(Box::new(shape)));
    let end = dummy(&mut scene);
    let raise = |object: &mut scene::Object| {
        let dummy = object.dummy_mut().unwrap();
        let (reals, ints) = dummy.engine_rows(Engine::Mujoco);
        let reals: Vec<f64> = reals.iter().map(|real| real + 0.5).collect();
        dummy.load_engine(Engine::Mujoco, &reals, &ints);
    };
    scene.modify(end, Field::Dynamics, raise).unwrap();
    returned(&scene);
}

#[test]
fn times_are_written_in_seconds_and_microseconds() {
    let mut scene = Scene::new();
    scene.modify_settings(|settings| {
        (settings.time_step, settings.time_to_pause) = (0.025, 7.5);
        settings.real_time_factor = 2.0;
        settings.dynamics.step = 0.0025;
        settings.environment.ambient_light = [0.5, 0.25, 0.125];
    });
    let contents = contents(&scene);
    let simulation = contents.simulation.unwrap();
    assert_eq!(
        (simulation.dt, simulation.dt_us, simulation.old_dt),
        (Some(0.025), Some(25_000), Some(0.025))
    );
    assert_eq!(
        (simulation.pause_time, simulation.pause_us),
        (Some(7.5), Some(7_500_000))
    );
    assert_eq!(
        (simulation.old_pause, simulation.old_preset),
        (Some(7.5), Some(5))
    );
    assert_eq!(
        (simulation.rt_coef, simulation.old_rt_coef),
        (Some(2.0), Some(2.0))
    );
    let dynamics = contents.dynamics.unwrap();
    assert_eq!(dynamics.step_size, Some(0.0025));
    for block in [
        dynamics.bullet,
        dynamics.ode,
        dynamics.vortex,
        dynamics.newton,
        dynamics.mujoco,
    ] {
        assert_eq!(block.unwrap().reals[0], 0.0025);
    }
    // Older programs double it.
    assert_eq!(
        contents.environment.unwrap().old_ambient,
        Some([0.25, 0.125, 0.0625])
    );
}

#[test]
fn the_main_script_of_the_program_is_marked_as_such() {
    let main = contents(&Scene::new()).scripts.remove(0);
    assert_eq!(
        (main.ids, main.lang),
        (Some([0, -1, 0]), Some("lua".into()))
    );
    // Bit 3 is clear; 6 and 7 are those of present scripts.
    assert_eq!(
        (main.switches, main.switches_2, main.exec_order),
        (Some(0xc0), Some(1), Some(1))
    );
    assert_eq!(main.cust_obj_handle, Some(-1));
    assert_eq!(main.text.unwrap().0, b"--lua\nrequire('defaultMainScript')");
    assert!(main.modules.is_some());
}

#[test]
fn what_all_objects_are_written_with() {
    let mut scene = Scene::new();
    let [base, other] = [dummy(&mut scene), dummy(&mut scene)];
    scene.set_old_name(base, "arm#2").unwrap();
    let collection = scene.collections_mut().add(false, None);
    let handles = [other.raw(), collection];
    scene
        .set_references(base, References::Following, "", &handles)
        .unwrap();
    let model = |object: &mut scene::Object| object.set_model_property(ModelFlags::empty());
    scene.modify(base, Field::ModelProperty, model).unwrap();
    let contents = contents(&scene);
    let common = &contents.objects[0].common;
    assert_eq!(common.signature, Some([57, 58, 59]));
    assert_eq!(common.alt_name, Some("arm_HASHMARK_2".into()));
    assert_eq!((common.switches, common.switches_2), (Some(1), Some(1)));
    let kinds: Vec<i32> = common
        .references
        .as_ref()
        .unwrap()
        .0
        .iter()
        .map(|r| r[0])
        .collect();
    assert_eq!(kinds, [109, 115]);
    // Namesakes have an order, and those with an alias of their own none.
    assert_eq!(
        (common.child_order, contents.objects[1].common.child_order),
        (Some(0), Some(1))
    );
    let mut alone = Scene::new();
    dummy(&mut alone);
    assert_eq!(
        self::contents(&alone).objects[0].common.child_order,
        Some(-1)
    );
}

#[test]
fn sensors_have_faces_and_old_kinds() {
    let mut sensor = proximity_sensor(VolumeType::Pyramid, true);
    let list = |number: f64| vec![number; 3];
    let faces = VolumeFaces {
        planes_inside: list(1.0),
        planes_outside: list(2.0),
        normals_inside: list(3.0),
        normals_outside: list(4.0),
        edges: list(5.0),
        close_edges: list(6.0),
    };
    sensor.set_file_faces(faces);
    let mut scene = Scene::new();
    add(&mut scene, Kind::ProximitySensor(Box::new(sensor)));
    returned(&scene);
    let Class::ProximitySensor(chunk) = contents(&scene).objects.remove(0).class else {
        panic!("no sensor")
    };
    let volume = chunk.volume.unwrap();
    assert_eq!(
        (chunk.sensor_type, volume.volume_type, chunk.sensable_type),
        (Some(30), Some(0), Some(16))
    );
    let lists = [
        volume.planes_inside,
        volume.planes_outside,
        volume.normals_inside,
        volume.normals_outside,
        volume.edges,
        volume.non_detect_edges,
    ];
    assert_eq!(
        lists.map(|list| list.unwrap().0[0]),
        [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]
    );
}

#[test]
fn cameras_say_twice_whether_they_are_perspective() {
    for perspective in [true, false] {
        let mut camera = Camera::default();
        camera.view.perspective = perspective;
        let Class::Camera(chunk) = chunk(Kind::Camera(Box::new(camera))) else {
            panic!("no camera")
        };
        assert_eq!(chunk.cpm, Some(perspective.into()));
        assert_eq!(chunk.switches_2, Some(if perspective { 3 } else { 1 }));
    }
}

#[test]
fn collections_that_only_sensors_look_for_are_saved() {
    let vision = VisionSensor::new(VisionOptions::empty(), [2, 2], None);
    let kinds = [
        Kind::ProximitySensor(Box::new(proximity_sensor(VolumeType::Ray, true))),
        Kind::VisionSensor(Box::new(vision)),
    ];
    for kind in kinds {
        let mut scene = Scene::new();
        let sensor = add(&mut scene, kind);
        let collection = Entity::from_raw(scene.collections_mut().add(false, None));
        let watch = |object: &mut scene::Object| match &mut object.kind {
            Kind::ProximitySensor(sensor) => sensor.entity = collection,
            Kind::VisionSensor(sensor) => sensor.entity = collection,
            _ => {}
        };
        scene.modify(sensor, Field::Sensor, watch).unwrap();
        assert_eq!(returned(&scene).collections().iter().count(), 1);
    }
}

fn cuboid() -> Shape {
    Shape::primitive(PrimitiveKind::Cuboid, [0.25, 0.5, 1.0], Default::default()).unwrap()
}

/// Two cuboids, one turned and beside the origin, with masses beside their middle, as one shape.
fn compound(scene: &mut Scene) -> Handle {
    let turned = Pose::new(
        [1.0, 2.0, 3.0].into(),
        [0.0, 0.0, std::f64::consts::FRAC_PI_2].into(),
    );
    let members = [Pose::identity(), turned].map(|pose| {
        let mut shape = cuboid();
        let com = [0.0625, 0.125, 0.25];
        shape.mass = MassProperties {
            com,
            ..MassProperties::diagonal(2.0, [0.5, 0.75, 1.0])
        };
        shape.parts[0].mass = shape.mass;
        let handle = add(scene, Kind::Shape(Box::new(shape)));
        scene.set_world_pose(handle, pose).unwrap();
        handle.raw()
    });
    let (group, members) = scene.group_shapes(&members, false).unwrap();
    scene.remove(&members).unwrap();
    // Files do not say what the members were called.
    let forget = |object: &mut scene::Object| {
        let parts = &mut object.shape_mut().unwrap().parts;
        parts.iter_mut().for_each(|part| part.alias.clear());
    };
    scene.modify(group, Field::Geometry, forget).unwrap();
    group
}

#[test]
fn compounds_have_their_geometry_in_both_layouts() {
    let mut scene = Scene::new();
    compound(&mut scene);
    returned(&scene);
    let Class::Shape(chunk) = contents(&scene).objects.remove(0).class else {
        panic!("no shape")
    };
    let ShapeChunk { geometry, .. } = *chunk;
    let root = geometry.unwrap().group.unwrap();
    assert_eq!(root.name, Some("sub__0".into()));
    let names: Vec<_> = root
        .children
        .iter()
        .map(|child| {
            let MeshTree::Mesh(mesh) = child else {
                panic!("no mesh")
            };
            let node = &mesh.node;
            // Frames of the new layout are relative, those of the old one cumulative: the same below the root.
            assert_eq!(node.frame, node.old_frame);
            let frame = node.frame.unwrap().pose().unwrap();
            let com = node.centre_of_mass.unwrap();
            let (axes, moments) = node.old_inertia.unwrap();
            let old = axes.pose().unwrap().translation.vector;
            let expected = (frame * nalgebra::Point3::from(com)).coords;
            assert!((old - expected).norm() < 1e-9);
            // The sum of the moments is the trace of the tensor.
            let inertia = node.inertia.unwrap();
            let trace = inertia[0] + inertia[4] + inertia[8];
            assert!((moments.iter().sum::<f64>() - trace).abs() < 1e-9);
            let vertices = frame * node.box_frame.unwrap().pose().unwrap();
            let old = mesh.data.old_vertex_frame.unwrap().pose().unwrap();
            assert!((old.translation.vector - vertices.translation.vector).norm() < 1e-9);
            assert!((0..3).all(|i| (node.box_size.unwrap()[i] - [0.25, 0.5, 1.0][i]).abs() < 1e-6));
            (node.name.clone().unwrap().decode(), node.switches)
        })
        .collect();
    assert_eq!(
        names,
        [
            ("sub__1".to_owned(), Some(4)),
            ("sub__2".to_owned(), Some(4))
        ]
    );
}

#[test]
fn clouds_and_trees_come_back_with_their_looks() {
    use scene::voxels::cloud_points::CloudPoints;
    use scene::voxels::octree::{OcTree, Voxel};
    use scene::voxels::point_cloud::{CloudPoint, PointCloud};
    for on in [true, false] {
        let mut tree = OcTree::new(0.25, 3.0);
        (tree.random_colours, tree.shows_points) = (on, !on);
        tree.insert(
            [0.125; 3],
            Voxel {
                colour: [1, 2, 3],
                tag: 7,
            },
        );
        let mut cloud = PointCloud {
            max_cell_size: 0.5,
            max_points_in_cell: 4,
            point_size: 6,
            uses_octree: on,
            display_fraction: 0.5,
            random_colours: !on,
            points: CloudPoints::default(),
        };
        let point = CloudPoint {
            position: [0.25, 0.5, 0.75],
            colour: [4, 5, 6],
        };
        cloud.insert([point].into_iter(), 0.0);
        let mut scene = Scene::new();
        for kind in [
            Kind::OcTree(Box::new(tree)),
            Kind::PointCloud(Box::new(cloud)),
        ] {
            let handle = add(&mut scene, kind);
            let paint = |object: &mut scene::Object| object.colour = COLOUR;
            scene.modify(handle, Field::Appearance, paint).unwrap();
        }
        // Colours of points in trees are as they were, cells are those of the tree.
        returned(&scene);
    }
}
