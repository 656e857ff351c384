//! Objects none of whose settings is as it is by default come back from files.

use super::super::Loaded;
use super::{assert_same, load, saved};
use scene::appearance::colour::Colour;
use scene::joint::{Control, Joint, JointDependency, JointMode, JointType};
use scene::object::assembly::Assembly;
use scene::object::dummy::{Dummy, LinkType};
use scene::object::movement::MovementFrame;
use scene::object::script_object::{ExecutionPriority, ScriptObject, ScriptType};
use scene::object::viewers::Viewers;
use scene::sensor::force_sensor::{ForceFilter, ForceSensor};
use scene::sensor::volume::VolumeType;
use scene::sensor::{
    Camera, Entity, Light, LightType, ProximityOptions, ProximitySensor, RenderMode, VisionOptions,
    VisionSensor,
};
use scene::{
    Data, Edit, Field, ForbiddenMovements, Handle, Kind, Layers, ModelFlags, Movement, Object,
    ObjectFlags, Pose, PreferredAxes, References, Scene, SpecialFlags,
};

/// Another one in all numbers, and translucent.
pub(super) const COLOUR: Colour = Colour {
    ambient_diffuse: [0.125, 0.25, 0.375],
    specular: [0.5, 0.625, 0.75],
    emission: [0.0625, 0.1875, 0.3125],
    auxiliary: [0.4375, 0.5625, 0.6875],
    opacity: 0.25,
};

pub(super) fn add(scene: &mut Scene, kind: Kind) -> Handle {
    scene.add("o", kind).unwrap()
}

pub(super) fn dummy(scene: &mut Scene) -> Handle {
    add(scene, Kind::Dummy(Dummy::new(0.5)))
}

fn change(scene: &mut Scene, handle: Handle, change: impl FnOnce(&mut Object)) {
    scene.modify(handle, Field::Other, change).unwrap();
}

/// The scene as its file has it, which is the same.
#[track_caller]
pub(super) fn returned(scene: &Scene) -> Scene {
    let (again, _) = load(&saved(scene, &Loaded::default()));
    assert_same(scene, &again, "what was saved");
    again
}

fn add_all(kinds: impl IntoIterator<Item = Kind>) -> Scene {
    let mut scene = Scene::new();
    kinds.into_iter().for_each(|kind| {
        let handle = add(&mut scene, kind);
        change(&mut scene, handle, |object| {
            object.colour = COLOUR;
            object.colour_extension = "openGL3 {}".into();
        });
    });
    scene
}

#[test]
fn what_all_objects_have() {
    let mut scene = Scene::new();
    let (eye, object) = (dummy(&mut scene), dummy(&mut scene));
    let pose = Pose::new([1.0, 2.0, 3.0].into(), [0.1, 0.2, 0.3].into());
    scene.set_world_pose(object, pose).unwrap();
    scene.set_old_name(object, "base#7").unwrap();
    change(&mut scene, object, |object| {
        object.object_property = ObjectFlags::SELECT_MODEL | ObjectFlags::COLLAPSED;
        object.special_property = SpecialFlags::MEASURABLE;
        object.set_model_property(ModelFlags::NOT_DYNAMIC | ModelFlags::NOT_RESET);
        object.layer = Layers::JOINTS | Layers::CAMERAS_AND_LIGHTS;
        object.viewers = Viewers::One(eye);
        (object.hierarchy_colour, object.self_collision_indicator) = (3, 4);
        object.persistent_uid = "its identity".into();
        object.dna = vec![1, 2, 255];
        (object.size_factor, object.size_values) = (2.0, [3.0, 4.0, 5.0]);
        object.priority = ExecutionPriority::Last;
        object.extension_string = "povray {}".into();
        object.user_params = vec![("speed".into(), "5".into()), ("name".into(), "x y".into())];
        object.movement = Movement {
            forbidden: ForbiddenMovements::empty(),
            step: [0.125, 0.25],
            relativity: [MovementFrame::OWN, MovementFrame::PARENT],
            preferred_axes: PreferredAxes::TRANSLATION_Z | PreferredAxes::ROTATION_X,
        };
        object.assembly = Assembly {
            pose,
            moves: true,
            child_words: vec!["gripper".into(), "tool".into()],
            parent_words: Vec::new(),
        };
        let remark = Data::text("made by hand");
        object.inert.set("modelAcknowledgment", remark);
        object
            .custom_data
            .edit(Edit::Tag("raw", Some(Data::Buffer(vec![0, 7]))));
    });
    for viewers in [Viewers::None, Viewers::All] {
        let other = dummy(&mut scene);
        change(&mut scene, other, |object| object.viewers = viewers);
    }
    let again = returned(&scene);
    assert_eq!(again.object(object).unwrap().old_name(), "base#7");
}

#[test]
fn each_forbidden_movement_by_itself() {
    let mut scene = Scene::new();
    for bit in 0..6 {
        let object = dummy(&mut scene);
        change(&mut scene, object, |object| {
            object.movement.forbidden = ForbiddenMovements::from_bits_retain(1 << bit);
        });
    }
    returned(&scene);
}

#[test]
fn references_and_originals() {
    let mut scene = Scene::new();
    let [first, second] = [dummy(&mut scene), dummy(&mut scene)];
    let collection = scene.collections_mut().add(true, None);
    let handles = [second.raw(), collection, first.raw()];
    for (kind, tag) in [(References::Following, ""), (References::Following, "tag")] {
        scene.set_references(first, kind, tag, &handles).unwrap();
    }
    for tag in ["", "tag"] {
        let originals = [second.raw(), first.raw()];
        scene
            .set_references(second, References::Original, tag, &originals)
            .unwrap();
    }
    let again = returned(&scene);
    let lists = &again.object(first).unwrap().references;
    assert_eq!(
        lists.iter().map(|(_, list)| list.len()).collect::<Vec<_>>(),
        [3, 3]
    );
    assert!(again.collections().get(lists[0].1[1]).unwrap().overrides);
    let originals = &again.object(second).unwrap().original_references;
    assert_eq!(originals.len(), 2);
    assert!(
        originals
            .iter()
            .all(|(_, list)| *list == [second.raw(), first.raw()])
    );
}

pub(super) fn joint(joint_type: JointType, control: Control) -> Joint {
    let mut joint = Joint::new(joint_type, JointMode::Dynamic);
    let turning = joint_type == JointType::Revolute;
    (joint.control, joint.hybrid, joint.cyclic) = (control, true, false);
    (joint.min, joint.range, joint.position) = (-0.25, 1.5, 0.125);
    (joint.target_position, joint.target_velocity) = (0.375, -0.5);
    joint.target_force = -3.0;
    (joint.max_vel, joint.max_accel, joint.max_jerk) = (4.0, 5.0, 6.0);
    joint.spring = [7.0, 8.0];
    joint.screw_lead = if turning { 0.75 } else { 0.0 };
    (joint.motor_lock, joint.enforce_limits) = (true, true);
    (joint.velocity_profile, joint.position_profile) = (true, true);
    (joint.ik.weight, joint.ik.max_step) = (0.5, 0.0625);
    joint.size = [0.5, 0.25];
    joint
}

#[test]
fn joints_of_all_types_and_controls() {
    use Control::{Callback, Force, Free, Position, Spring, Velocity};
    let revolute = [Free, Force, Velocity, Position, Spring, Callback]
        .map(|control| joint(JointType::Revolute, control));
    let mut ball = Joint::new(JointType::Spherical, JointMode::Kinematic);
    ball.spherical = nalgebra::UnitQuaternion::from_euler_angles(0.1, 0.2, 0.3);
    let plain = Joint::new(JointType::Revolute, JointMode::Kinematic);
    let others = [joint(JointType::Prismatic, Velocity), ball, plain];
    let joints = revolute.into_iter().chain(others);
    let mut scene = add_all(joints.map(|joint| Kind::Joint(Box::new(joint))));
    let all: Vec<Handle> = scene.objects().map(Object::handle).collect();
    scene
        .try_modify(all[8], Field::Joint, |object| {
            let follower = object.joint_mut()?;
            follower.mode = JointMode::Dependent;
            let (offset, coefficient) = (0.25, -2.0);
            let master = all[0];
            follower.dependency = Some(JointDependency {
                master,
                offset,
                coefficient,
            });
            Ok(())
        })
        .unwrap();
    returned(&scene);
}

#[test]
fn force_sensors_and_linked_dummies() {
    let sensor = |filter, by_force| ForceSensor {
        size: 0.5,
        filter,
        sample_size: 7,
        force_threshold: 12.0,
        force_threshold_enabled: by_force,
        torque_threshold: 3.0,
        torque_threshold_enabled: !by_force,
        consecutive_violations: 4,
        ..ForceSensor::default()
    };
    let sensors = [
        sensor(ForceFilter::Median, true),
        sensor(ForceFilter::Average, false),
    ];
    let mut scene = add_all(sensors.map(|sensor| Kind::ForceSensor(Box::new(sensor))));
    for link_type in [LinkType::LoopClosure, LinkType::Tendon, LinkType::Assembly] {
        let [first, second] = [dummy(&mut scene), dummy(&mut scene)];
        scene.link_dummies(first, Some(second)).unwrap();
        scene.set_link_type(first, link_type).unwrap();
        change(&mut scene, first, |object| {
            object.dummy_mut().unwrap().assembly_tag = "wrist".into();
        });
    }
    returned(&scene);
}

pub(super) fn proximity_sensor(volume_type: VolumeType, is_on: bool) -> ProximitySensor {
    let floats = [
        0.0, 3.0, 0.2, 0.3, 1.0, 1.25, 0.4, 0.05, 0.5, 1.2, 0.0, 0.0, 0.01, 0.0, 0.0,
    ];
    let integers = ProximitySensor::INTEGERS;
    let options = ProximityOptions::empty();
    let mut sensor = ProximitySensor::new(volume_type, options, integers, Some(floats));
    (sensor.explicit, sensor.show_volume, sensor.exact) = (is_on, is_on, is_on);
    (sensor.front_faces, sensor.back_faces) = (is_on, !is_on);
    (sensor.randomized, sensor.samples, sensor.required_samples) = (is_on, 20, 3);
    (sensor.angle_threshold, sensor.size, sensor.ray_colour) = (0.5, 0.25, COLOUR);
    let volume = &mut sensor.volume;
    (volume.offset, volume.inside_gap, volume.close_threshold) = (0.125, 0.5, 0.0625);
    (volume.faces, volume.subdivisions) = ([16, 8], [2, 3]);
    sensor
}

pub(super) fn vision_sensor(is_on: bool) -> VisionSensor {
    let mut sensor = VisionSensor::new(VisionOptions::empty(), [20, 10], None);
    let view = &mut sensor.view;
    (view.perspective, view.show_frustum) = (is_on, !is_on);
    (view.clipping, view.angle, view.ortho_size) = ([0.25, 40.0], 0.5, 3.0);
    (sensor.explicit, sensor.external_image, sensor.ignore_depth) = (is_on, is_on, is_on);
    (sensor.ignore_image, sensor.local_lights, sensor.ignore_fog) = (!is_on, !is_on, !is_on);
    (sensor.background_from_environment, sensor.omit_statistics) = (is_on, is_on);
    (sensor.size, sensor.background) = (0.5, [0.25, 0.5, 0.75]);
    sensor.render_mode = RenderMode::AUXILIARY;
    sensor
}

#[test]
fn sensors_and_what_they_look_for() {
    use VolumeType::{Cone, Cylinder, Disc, Pyramid, Ray};
    let kinds = [Pyramid, Cylinder, Disc, Cone, Ray].map(|kind| proximity_sensor(kind, true));
    let off = proximity_sensor(Ray, false);
    let proximity = kinds.into_iter().chain([off]);
    let proximity = proximity.map(|sensor| Kind::ProximitySensor(Box::new(sensor)));
    let vision = [true, false].map(|on| Kind::VisionSensor(Box::new(vision_sensor(on))));
    let mut scene = add_all(proximity.chain(vision));
    let all: Vec<Handle> = scene.objects().map(Object::handle).collect();
    change(&mut scene, all[0], |object| {
        object.proximity_sensor_mut().unwrap().entity = all[1].into();
    });
    change(&mut scene, all[6], |object| {
        object.vision_sensor_mut().unwrap().entity = all[1].into();
    });
    returned(&scene);
}

#[test]
fn sensors_look_for_collections() {
    let mut scene = add_all([
        Kind::ProximitySensor(Box::new(proximity_sensor(VolumeType::Ray, true))),
        Kind::VisionSensor(Box::new(vision_sensor(true))),
    ]);
    let all: Vec<Handle> = scene.objects().map(Object::handle).collect();
    let collection = Entity::from_raw(scene.collections_mut().add(false, None));
    change(&mut scene, all[0], |object| {
        object.proximity_sensor_mut().unwrap().entity = collection;
    });
    change(&mut scene, all[1], |object| {
        object.vision_sensor_mut().unwrap().entity = collection;
        object.viewers = Viewers::Collection(collection.raw());
    });
    returned(&scene);
}

#[test]
fn cameras_lights_and_scripts() {
    let camera = |is_on: bool| {
        let mut camera = Camera::default();
        (camera.view.perspective, camera.view.show_frustum) = (is_on, !is_on);
        (camera.view.clipping, camera.view.angle) = ([0.25, 40.0], 0.5);
        (camera.view.ortho_size, camera.size) = (3.0, 0.5);
        Kind::Camera(Box::new(camera))
    };
    let light = |light_type, is_on: bool| {
        let mut light = Light::new(light_type);
        (light.enabled, light.casts_shadows, light.size) = (is_on, !is_on, 0.5);
        (light.spot_exponent, light.spot_cutoff) = (7, 0.75);
        light.attenuation = [0.25, 0.5, 0.125];
        light.colour = COLOUR;
        Kind::Light(Box::new(light))
    };
    let script = |script_type, language: &str, is_on: bool| {
        let mut script = ScriptObject::new(script_type, b"x = 1\n".to_vec(), language, !is_on);
        (script.parent_is_proxy, script.reset_after_sim_error) = (is_on, is_on);
        script.size = 0.5;
        Kind::Script(Box::new(script))
    };
    let kinds = [
        camera(true),
        camera(false),
        light(LightType::Spot, true),
        light(LightType::Directional, false),
        script(ScriptType::Simulation, "lua", true),
        script(ScriptType::Customization, "python", false),
        script(ScriptType::Passive, "lua", true),
    ];
    let mut scene = add_all(kinds);
    let all: Vec<Handle> = scene.objects().map(Object::handle).collect();
    change(&mut scene, all[0], |object| {
        if let Kind::Camera(camera) = &mut object.kind {
            camera.tracked = Some(all[2]);
        }
    });
    returned(&scene);
}
