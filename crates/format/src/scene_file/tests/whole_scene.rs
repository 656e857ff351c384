//! What a scene has beside its objects comes back from its file, as a model takes along what belongs to it.

use super::super::save;
use super::everything::{COLOUR, add, dummy, returned};
use scene::appearance::environment::{Environment, Fog, FogType};
use scene::object::script_object::{ScriptObject, ScriptType};
use scene::parameters::engine::{Engine, SelectedEngine};
use scene::sensor::Camera;
use scene::tree::calculation_objects::CalculationObject;
use scene::tree::ik_groups::{IkElement, IkGroup};
use scene::{
    Calculations, CollectionItem, Data, DynamicsSettings, Edit, Handle, ItemOptions, Kind, Layers,
    Members, Scene, Settings, ValueType, special,
};

/// With every switch in that position; steps, times and colours are never the usual ones.
fn settings(on: bool) -> Settings {
    let engine = if on { Engine::Newton } else { Engine::Ode };
    Settings {
        time_step: 0.02,
        real_time: on,
        real_time_factor: 2.0,
        remove_new_objects_at_end: !on,
        pause_at_error: !on,
        pause_at_time: on,
        time_to_pause: 7.5,
        dynamics: DynamicsSettings {
            enabled: !on,
            step: 0.0025,
            gravity: [1.0, 2.0, -3.0],
            engine: SelectedEngine {
                engine,
                version: if on { 283 } else { 0 },
            },
            show_contact_points: on,
            ..DynamicsSettings::default()
        },
        visibility_layers: Layers::JOINTS,
        steps_per_rendering: 3,
        acknowledgment: "made by hand".into(),
        locked: on,
        environment: environment(on),
        calculations: Calculations {
            collision: on,
            distance: !on,
            proximity_sensors: on,
            paths: !on,
            inverse_kinematics: on,
        },
        ..Settings::default()
    }
}

fn environment(on: bool) -> Environment {
    let background = [[0.25, 0.5, 0.75], [0.125, 0.375, 0.625]];
    Environment {
        fog: Fog {
            enabled: on,
            fog_type: FogType::EXPONENTIAL,
            start: 0.5,
            end: on.then_some(8.0),
            density: 0.25,
            colour: on.then_some([0.5, 0.25, 0.125]),
        },
        ambient_light: [0.25, 0.125, 0.5],
        background: on.then_some(background),
        display: if on { 0x45 } else { 0 },
        triangle_sizes: [0.5, 0.25],
        extension_string: "openGL3 {}".into(),
    }
}

#[test]
fn settings_with_all_switches() {
    for on in [true, false] {
        let mut scene = Scene::new();
        scene.modify_settings(|kept| *kept = settings(on));
        scene
            .custom_data
            .edit(Edit::Tag("raw", Some(Data::Buffer(vec![1, 2]))));
        returned(&scene);
    }
}

#[test]
fn custom_data_of_all_types() {
    let floats = |list: &[f64]| Data::Array(list.iter().map(|f| Data::Float(*f)).collect());
    let ints = |list: &[i64]| Data::Array(list.iter().map(|i| Data::Int(*i)).collect());
    let values = [
        (ValueType::Bool, Data::Bool(true)),
        (ValueType::Int, Data::Int(-5)),
        (ValueType::Int, Data::Int(1 << 40)),
        (ValueType::Long, Data::Int(7)),
        (ValueType::Float, Data::Float(0.1)),
        (ValueType::String, Data::text("word")),
        (ValueType::Vector3, floats(&[0.1, 0.2, 0.3])),
        (ValueType::Color, floats(&[0.25, 0.5, 0.75])),
        (ValueType::IntArray, ints(&[1, -2, 70_000])),
        (ValueType::IntArray2, ints(&[3, 4])),
        (ValueType::Table, Data::map([("key", Data::Bool(false))])),
        (ValueType::Bool, Data::Bool(false)),
    ];
    let mut scene = Scene::new();
    for (at, (ty, value)) in values.into_iter().enumerate() {
        let tag = ty.tag(&format!("value {at}"));
        scene.custom_data.edit(Edit::Tag(&tag, Some(value)));
    }
    returned(&scene);
}

fn calculation<R>(name: &str, entities: [i64; 2]) -> CalculationObject<R> {
    CalculationObject {
        name: name.into(),
        persistent_uid: "identity".into(),
        entities,
        threshold: 0.5,
        explicit: false,
        switches: 3,
        result: None,
    }
}

#[test]
fn collections_with_items_of_all_kinds() {
    let mut scene = Scene::new();
    let base = dummy(&mut scene);
    let (subtract, rest) = (ItemOptions::SUBTRACT, ItemOptions::EXCLUDE_BASE);
    let items = [
        CollectionItem::new(Members::Single(base), ItemOptions::empty()),
        CollectionItem::new(Members::Tree(base), subtract),
        CollectionItem::new(Members::Tree(base), rest),
        CollectionItem::new(Members::Chain(base), ItemOptions::empty()),
        CollectionItem::new(Members::Chain(base), rest | subtract),
    ];
    let named = scene.collections_mut().add(true, None);
    scene
        .collections_mut()
        .set_name(named, "all".into())
        .unwrap();
    scene.collections_mut().get_mut(named).unwrap().items = items.to_vec();
    let again = returned(&scene);
    let handle = again.collections().named("all").unwrap();
    assert_eq!(
        again.collections().get(handle),
        scene.collections().get(named)
    );
}

#[test]
fn collections_nobody_refers_to_are_left_out_if_they_have_no_name_or_all_as_members() {
    let mut scene = Scene::new();
    dummy(&mut scene);
    scene.collections_mut().add(true, None);
    let named = scene.collections_mut().add(true, None);
    scene
        .collections_mut()
        .set_name(named, "everything".into())
        .unwrap();
    let everything = CollectionItem::new(Members::All, ItemOptions::empty());
    scene
        .collections_mut()
        .get_mut(named)
        .unwrap()
        .items
        .push(everything);
    assert_eq!(returned(&scene).collections().iter().count(), 0);
}

#[test]
fn collision_and_distance_objects() {
    let mut scene = Scene::new();
    let [first, second] = [dummy(&mut scene), dummy(&mut scene)].map(Handle::raw);
    let collection = scene.collections_mut().add(true, None);
    let all = special::ALL;
    for (name, entities) in [
        ("a", [first, second]),
        ("b", [second, all]),
        ("c", [collection, first]),
    ] {
        scene
            .collision_objects_mut()
            .add(calculation(name, entities));
        scene
            .distance_objects_mut()
            .add(calculation(name, entities));
    }
    let again = returned(&scene);
    assert_eq!(again.distance_objects().iter().count(), 3);
    for (handle, object) in scene.distance_objects().iter() {
        assert_eq!(again.distance_objects().get(handle), Some(object));
    }
    for (handle, object) in scene.collision_objects().iter() {
        // They have no threshold.
        let expected = CalculationObject {
            threshold: 0.0,
            ..object.clone()
        };
        assert_eq!(again.collision_objects().get(handle), Some(&expected));
    }
}

#[test]
fn groups_of_inverse_kinematics() {
    let mut scene = Scene::new();
    let [tip, base] = [dummy(&mut scene), dummy(&mut scene)];
    let element = IkElement {
        base: Some(base),
        constraint_base: Some(tip),
        precisions: [0.25, 0.5],
        weights: [0.75, 0.125],
        constraints: 5,
        flags: 3,
        ..IkElement::new(tip)
    };
    for (name, explicit) in [("one", true), ("two", false)] {
        let group = IkGroup {
            persistent_uid: "identity".into(),
            explicit,
            method: 1,
            flags: 5,
            performed_after: 2,
            max_iterations: 9,
            damping: 0.5,
            elements: vec![element.clone(), IkElement::new(base)],
            ..IkGroup::new(name)
        };
        scene.ik_groups_mut().add(group);
    }
    let again = returned(&scene);
    assert!(again.ik_groups().iter().eq(scene.ik_groups().iter()));
}

#[test]
fn texts_are_behind_the_name_of_their_language_unless_they_begin_with_blank_lines() {
    for (code, language, stored) in [
        ("x = 1", "lua", "--lua\nx = 1"),
        ("x = 1", "python", "#python\nx = 1"),
        ("\n  \nx = 1", "lua", "\n  \nx = 1"),
        ("", "lua", "--lua\n"),
    ] {
        let mut scene = Scene::new();
        let object = ScriptObject::new(ScriptType::Simulation, code.into(), language, false);
        add(&mut scene, Kind::Script(Box::new(object)));
        let file = save::scene(&scene, &[]).unwrap();
        let crate::ttt::tree::Class::ScriptObject(chunk) = &file.contents.objects[0].class else {
            panic!("no script")
        };
        let text = chunk.script.as_ref().unwrap().text.as_ref().unwrap();
        assert_eq!(text.0, stored.as_bytes());
        returned(&scene);
    }
}

#[test]
fn the_order_of_the_tree_is_that_of_the_scene() {
    let mut scene = Scene::new();
    let handles: Vec<Handle> = (0..6).map(|_| dummy(&mut scene)).collect();
    for (child, parent) in [(1, 0), (2, 0), (3, 2), (5, 4)] {
        scene
            .set_parent(handles[child], Some(handles[parent]), true)
            .unwrap();
    }
    scene.set_hierarchy_order(handles[2], 0).unwrap();
    let file = save::scene(&scene, &[]).unwrap();
    let order = file
        .contents
        .objects
        .iter()
        .map(|object| object.common.handles.unwrap()[0]);
    let expected = [0, 2, 3, 1, 4, 5].map(|at: usize| handles[at].0.cast_signed());
    assert_eq!(order.collect::<Vec<_>>(), expected);
    returned(&scene);
}

#[test]
fn the_window_shows_what_the_first_camera_sees() {
    let mut scene = Scene::new();
    assert!(save::scene(&scene, &[]).unwrap().contents.views.is_none());
    dummy(&mut scene);
    let camera = add(&mut scene, Kind::Camera(Box::default()));
    add(&mut scene, Kind::Camera(Box::<Camera>::default()));
    let views = save::scene(&scene, &[]).unwrap().contents.views.unwrap();
    let view = &views.pages[0].views[0];
    assert_eq!(view.linked_object, Some(camera.0.cast_signed()));
}

#[test]
fn colours_are_written_for_old_programs_too() {
    let mut scene = Scene::new();
    let handle = dummy(&mut scene);
    scene
        .modify(handle, scene::Field::Other, |object| object.colour = COLOUR)
        .unwrap();
    let file = save::scene(&scene, &[]).unwrap();
    let crate::ttt::tree::Class::Dummy(chunk) = &file.contents.objects[0].class else {
        panic!("no dummy")
    };
    let colour = chunk.colour.as_ref().unwrap();
    // Bit 2 is clear where it is translucent (spec: scene-files 7.1).
    assert_eq!((colour.flags, colour.opacity), (Some(0), Some(0.25)));
    let old = colour.old_values.unwrap();
    // Old programs add half of the diffuse mean and divide by 0.85.
    let joined = |at: usize| (old[at] + (old[3] + old[4] + old[5]) / 6.0) / 0.85;
    assert!((0..3).all(|at| (joined(at) - COLOUR.ambient_diffuse[at]).abs() < 1e-6));
    assert_eq!(old[6..9], COLOUR.specular);
    assert_eq!(old[9..12], COLOUR.emission);
}
