//! Collections, and what scenes before 4.2 had beside their objects.

use super::{file, loaded, object};
use crate::ttt::File;
use crate::ttt::chunks::{
    Button, ButtonBlock, Collection, CollectionElement, Collision, Distance, IkElement, IkGroup,
};
use crate::ttt::tree::{Class, Contents};
use scene::{CollectionItem, ItemOptions, Members, Scene, special};

/// A scene with two dummies, whose handles in the file are 0 and 999,999, and a collection, 1,000,000.
fn with_dummies(change: impl FnOnce(&mut Contents)) -> (Scene, [i64; 3]) {
    let dummies = [0, 999_999].map(|handle| object(handle, -1, Class::Dummy(Box::default())));
    let mut contents = Contents {
        objects: dummies.into(),
        collections: vec![Collection {
            handle: Some(1_000_000),
            ..Collection::default()
        }],
        ..Contents::default()
    };
    change(&mut contents);
    let (scene, made) = loaded(file(40_100, 22, contents));
    let collection = scene
        .collections()
        .iter()
        .next()
        .map_or(-1, |(handle, _)| handle);
    (
        scene,
        [made.objects[0].raw(), made.objects[1].raw(), collection],
    )
}

#[test]
fn entities_of_calculations() {
    let entities = [
        [0, 999_999, 5],
        [1_000_000, 77, 6],
        [77, 0, 7],
        [1_000_001, 0, 8],
    ];
    let (scene, [first, second, collection]) = with_dummies(|contents| {
        for entities in entities.map(Some) {
            contents.collisions.push(Collision {
                entities_and_handle: entities,
                ..Collision::default()
            });
            contents.distances.push(Distance {
                entities_and_handle: entities,
                threshold: Some(if entities == Some([0, 999_999, 5]) {
                    0.5
                } else {
                    f64::NAN
                }),
                ..Distance::default()
            });
        }
        contents.collisions.push(Collision::default());
    });
    let expected = [[first, second], [collection, special::ALL]];
    let collisions = scene
        .collision_objects()
        .iter()
        .map(|(_, object)| object.entities);
    assert_eq!(collisions.collect::<Vec<_>>(), expected);
    let distances = scene
        .distance_objects()
        .iter()
        .map(|(_, object)| (object.entities, object.threshold));
    assert_eq!(
        distances.collect::<Vec<_>>(),
        [(expected[0], 0.5), (expected[1], 0.0)]
    );
}

#[test]
fn items_of_collections() {
    let (scene, [first, second, collection]) = with_dummies(|contents| {
        let element = |kind, base, flags| CollectionElement {
            handles: Some([base, 0]),
            kind: Some(kind),
            flags,
        };
        let collection = &mut contents.collections[0];
        (collection.flags, collection.name) = (Some(0xfe), Some("collection1000000".into()));
        collection.elements = vec![
            element(0, 0, Some(1)),
            element(1, 999_999, Some(0xfe)),
            element(2, 0, None),
            element(3, 0, None),
            element(4, 0, None),
            element(5, -1, None),
            element(0, 77, None),
        ];
    });
    let found = scene.collections().get(collection).unwrap();
    let [first, second] = [first, second].map(|raw| scene::Handle::from_raw(raw).unwrap());
    let item = |members, options: ItemOptions| CollectionItem::new(members, options);
    let (all, rest) = (ItemOptions::empty(), ItemOptions::EXCLUDE_BASE);
    let expected = [
        item(Members::Single(first), all),
        item(Members::Tree(second), ItemOptions::SUBTRACT),
        item(Members::Tree(first), rest),
        item(Members::Chain(first), all),
        item(Members::Chain(first), rest),
        item(Members::All, all),
    ];
    assert_eq!(found.items, expected);
    assert!(!found.overrides && found.name.is_empty());
}

#[test]
fn elements_of_inverse_kinematics() {
    let element = |tip, base, old_precisions, precisions, weights| IkElement {
        tip_and_base: Some([tip, base]),
        old_precisions,
        precisions,
        weights,
        ..IkElement::default()
    };
    let (scene, _) = with_dummies(|contents| {
        let nan = Some([f64::NAN, 1.0]);
        let elements = vec![
            element(0, 999_999, Some([180.0, 0.5]), None, Some([0.25, 0.5])),
            element(999_999, 77, Some([180.0, 0.5]), Some([0.125, 0.25]), nan),
            element(77, 0, None, None, None),
            element(0, -1, None, nan, None),
        ];
        let group = IkGroup {
            elements,
            flags: Some(0x41),
            damping: Some(f64::NAN),
            ..IkGroup::default()
        };
        contents.ik_groups = vec![
            group,
            IkGroup {
                flags: Some(0xbf),
                ..IkGroup::default()
            },
        ];
    });
    let groups: Vec<_> = scene.ik_groups().iter().map(|(_, group)| group).collect();
    assert_eq!(
        (groups[0].explicit, groups[0].flags, groups[0].damping),
        (true, 1, 0.1)
    );
    assert_eq!((groups[1].explicit, groups[1].flags), (false, 0xbf));
    assert_eq!(
        (groups[0].max_iterations, groups[0].performed_after),
        (3, -1)
    );
    let [first, second, third] = &groups[0].elements[..] else {
        panic!("three have a tip")
    };
    assert_eq!(
        (first.precisions, first.weights),
        ([std::f64::consts::PI, 0.5], [0.25, 0.5])
    );
    assert_eq!(
        (second.precisions, second.weights),
        ([0.125, 0.25], [1.0; 2])
    );
    assert_eq!((third.precisions, third.base), ([0.001; 2], None));
    assert!(first.base.is_some() && second.base.is_none());
}

#[test]
fn buttons_without_a_look_are_left_out_and_sliders_have_ends() {
    let button = |slider| Button {
        look: Some(([0x12, 7, 3, 1, 5, 6], "up".into(), "down".into(), slider)),
        ..Button::default()
    };
    let (scene, _) = with_dummies(|contents| {
        let buttons = vec![
            button(0.5),
            button(-3.0),
            button(f64::NAN),
            Button::default(),
        ];
        contents.button_blocks = vec![ButtonBlock {
            buttons,
            ..ButtonBlock::default()
        }];
    });
    let (_, interface) = scene.button_interfaces().iter().next().unwrap();
    let sliders = interface.buttons.iter().map(|button| button.slider);
    assert_eq!(sliders.collect::<Vec<_>>(), [0.5, -1.0, 0.0]);
    let button = &interface.buttons[0];
    assert_eq!((button.attributes, button.number), (0x12, 7));
    assert_eq!((button.span, button.cell), ([3, 1], [5, 6]));
}

/// A model whose names end with 2, in a scene where these are taken.
#[test]
fn names_are_numbered_as_those_of_the_objects_are() {
    let model = || {
        let mut base = object(1, -1, Class::Dummy(Box::default()));
        base.common.name = Some("base#2".into());
        let script = crate::ttt::chunks::Script {
            ids: Some([0, 1, 1]),
            ..Default::default()
        };
        let collision = |name: &str| Collision {
            entities_and_handle: Some([1, -1, 0]),
            name: Some(name.into()),
            ..Collision::default()
        };
        let contents = Contents {
            objects: vec![base],
            scripts: vec![script],
            collisions: vec![collision("hit#2"), collision("other")],
            model_info: Some(Default::default()),
            ..Contents::default()
        };
        file(40_100, 22, contents)
    };
    let mut scene = Scene::new();
    let mut add = |file: File| {
        let loaded = super::SceneFile::new(file)
            .unwrap()
            .add_to(&mut scene, false);
        let base = loaded.unwrap().root.unwrap();
        let name = scene.object(base).unwrap().old_name().to_owned();
        let names = scene
            .collision_objects()
            .iter()
            .map(|(_, object)| object.name.clone());
        (name, names.collect::<Vec<_>>())
    };
    let (name, names) = add(model());
    let suffix = |name: &str| name.split_once('#').map(|(_, number)| number.to_owned());
    assert_eq!(suffix(&name), suffix(&names[0]), "{name} {names:?}");
    let (name, names) = add(model());
    assert_eq!(suffix(&name), suffix(&names[2]), "{name} {names:?}");
}
