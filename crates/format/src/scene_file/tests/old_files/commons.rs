//! What all objects have, and the tree of them.

use super::{file, loaded, object, objects, one_of};
use crate::ttt::chunks::{Common, Script as ScriptChunk, UserParams};
use crate::ttt::tree::{Class, Contents, Object as FileObject};
use crate::ttt::{Counted, OriginalReference, Text};
use scene::object::assembly::Assembly;
use scene::object::script_object::ExecutionPriority;
use scene::object::viewers::Viewers;
use scene::{
    Data, ForbiddenMovements, Layers, MeasuredVelocity, ModelFlags, Object, ObjectFlags, Pose,
    ReferenceLists,
};

fn dummy(handle: i32, parent: i32, change: impl FnOnce(&mut Common)) -> FileObject {
    let mut object = object(handle, parent, Class::Dummy(Box::default()));
    change(&mut object.common);
    object
}

fn one(change: impl FnOnce(&mut Common)) -> Object {
    one_of(41_000, 25, dummy(1, -1, change))
}

#[test]
fn an_object_of_which_nothing_is_said() {
    let object = one(|_| {});
    assert_eq!((object.size_factor, object.size_values), (1.0, [1.0; 3]));
    assert_eq!(
        (object.hierarchy_colour, object.self_collision_indicator),
        (-1, 0)
    );
    assert_eq!(
        (object.priority, object.viewers),
        (ExecutionPriority::Normal, Viewers::All)
    );
    assert_eq!(
        (object.model_property, object.assembly),
        (ModelFlags::NOT_MODEL, Assembly::default())
    );
    assert_eq!(
        (object.layer, object.measured),
        (Layers::DUMMIES, MeasuredVelocity::default())
    );
    assert!(object.movement.forbidden.is_empty());
}

#[test]
fn aliases_were_names_up_to_the_number() {
    let alias = |name: Option<&str>, alias: Option<&str>| {
        let text = |text: Option<&str>| text.map(Text::from);
        let object = one(|common| (common.name, common.alias) = (text(name), text(alias)));
        object.alias().to_owned()
    };
    assert_eq!(alias(Some("arm#3"), None), "arm");
    assert_eq!(alias(Some("arm#3"), Some("hand")), "hand");
}

#[test]
fn objects_were_hidden_where_a_bit_is_missing() {
    let seen = |property, layer| {
        let object = one(|common| {
            (common.object_property, common.layer) = (Some(property), Some(layer));
        });
        (object.object_property, object.layer.bits())
    };
    assert_eq!(seen(0x24, 0x1), (ObjectFlags::SELECTABLE, 0x1));
    assert_eq!(seen(0x20, 0x1), (ObjectFlags::SELECTABLE, 0x100));
    assert_eq!(seen(0x20, 0x100), (ObjectFlags::SELECTABLE, 0x100));
    assert_eq!(seen(0x20, 0xff), (ObjectFlags::SELECTABLE, 0xff00));
}

#[test]
fn the_switch_of_a_model_has_been_in_three_places() {
    let property = |switches: [Option<u8>; 3]| {
        let object = one(|common| {
            [common.switches, common.switches_2, common.old_switches] = switches;
            common.model_property = Some(0x20);
        });
        object.model_property == ModelFlags::NOT_DYNAMIC
    };
    assert!(property([Some(1), Some(0), Some(0)]) && !property([Some(0), Some(1), Some(1)]));
    assert!(property([None, Some(1), Some(0)]) && !property([None, Some(0xfe), Some(1)]));
    assert!(property([None, None, Some(1)]) && !property([None, None, Some(0xfe)]));
}

#[test]
fn forbidden_movements_were_once_the_same_for_moving_and_turning() {
    use ForbiddenMovements as Forbidden;
    let forbidden = |new, second, oldest, locks| {
        let object = one(|common| {
            (common.switches, common.switches_2) = (new, second);
            (common.old_switches, common.locks) = (oldest, locks);
        });
        object.movement.forbidden
    };
    for (bit, expected) in [
        (1, Forbidden::TRANSLATION_RUNNING),
        (2, Forbidden::TRANSLATION_STOPPED),
        (4, Forbidden::ROTATION_RUNNING),
        (5, Forbidden::ROTATION_STOPPED),
    ] {
        assert_eq!(
            forbidden(Some(1 << bit), Some(0xff), Some(0xff), None),
            expected
        );
    }
    let running = Forbidden::TRANSLATION_RUNNING | Forbidden::ROTATION_RUNNING;
    let stopped = Forbidden::TRANSLATION_STOPPED | Forbidden::ROTATION_STOPPED;
    assert_eq!(forbidden(None, Some(2), Some(4), None), running);
    assert_eq!(forbidden(None, None, Some(4), None), stopped);
    assert_eq!(
        forbidden(None, None, None, Some(1)),
        Forbidden::OTHER_TRANSLATIONS
    );
    assert_eq!(
        forbidden(None, None, None, Some(0xfe)),
        Forbidden::OTHER_ROTATIONS
    );
}

#[test]
fn words_of_assembly_were_numbers() {
    let words = |numbers, switches| {
        let object = one(|common| {
            (common.old_assembly, common.old_switches) = (Some(numbers), Some(switches));
        });
        [object.assembly.child_words, object.assembly.parent_words]
    };
    let none: Vec<String> = Vec::new();
    assert_eq!(
        words([0, 7], 0),
        [vec!["default".to_owned()], vec!["7".to_owned()]]
    );
    assert_eq!(words([0, 7], 0x20), [none.clone(), vec!["7".to_owned()]]);
    assert_eq!(words([5, 7], 0x40), [vec!["5".to_owned()], none.clone()]);
    assert_eq!(words([5, 7], 0x9f)[0], ["5"]);
    let new = one(|common| {
        common.assembly = Some((Counted(vec!["a".into()]), Counted(Vec::new())));
        common.old_assembly = Some([1, 2]);
    });
    assert_eq!(
        [new.assembly.child_words, new.assembly.parent_words],
        [vec!["a".to_owned()], none]
    );
}

#[test]
fn a_place_for_assembly_counts_by_a_switch_that_came_later() {
    let moves = |serialization, switches, pose: Pose| {
        let object = dummy(1, -1, |common| {
            (common.switches, common.assembly_pose) = (switches, Some(pose.into()));
        });
        one_of(40_000, serialization, object).assembly.moves
    };
    let (here, there) = (Pose::identity(), Pose::translation(1.0, 0.0, 0.0));
    assert!(moves(20, Some(0x80), here) && !moves(20, Some(0x7f), there));
    assert!(!moves(19, Some(0x80), here) && moves(19, Some(0), there));
    assert!(!moves(25, None, here) && moves(25, None, there));
}

#[test]
fn numbers_that_are_no_sizes_leave_the_default() {
    let sizes = |factor, value| {
        let object = one(|common| {
            (common.size_factor, common.size_values) = (Some(factor), Some([1.0, value, 1.0]));
        });
        (object.size_factor, object.size_values)
    };
    assert_eq!(sizes(2.0, 3.0), (2.0, [1.0, 3.0, 1.0]));
    for factor in [0.0, -1.0, f64::NAN] {
        assert_eq!(sizes(factor, f64::INFINITY), (1.0, [1.0; 3]));
    }
}

#[test]
fn texts_that_are_empty_mean_nothing() {
    let own = one(|_| {});
    let object = one(|common| {
        common.persistent_id = Some("".into());
        (common.dna, common.acknowledgment) = (Some("".into()), Some("".into()));
    });
    assert_eq!(
        object.persistent_uid.is_empty(),
        own.persistent_uid.is_empty()
    );
    assert_eq!(object.dna.is_empty(), own.dna.is_empty());
    assert_eq!(object.inert.get("modelAcknowledgment"), None);
    let thanks = one(|common| common.acknowledgment = Some("thanks".into()));
    assert_eq!(
        thanks.inert.get("modelAcknowledgment"),
        Some(&Data::text("thanks"))
    );
}

#[test]
fn an_object_is_seen_by_one_or_by_all_where_that_one_is_gone() {
    let viewers = |viewer| {
        let of = |common: &mut Common| common.authorized_viewable = Some(viewer);
        let (scene, handles) = objects(
            41_000,
            25,
            vec![dummy(0, -1, |_| {}), dummy(999_999, -1, of)],
        );
        let viewers = scene.object(handles[1]).unwrap().viewers;
        (viewers, handles)
    };
    let (first, handles) = viewers(0);
    assert_eq!(first, Viewers::One(handles[0]));
    assert_eq!(viewers(999_999).0, Viewers::One(handles[1]));
    assert_eq!(viewers(-2).0, Viewers::None);
    assert_eq!(
        [viewers(-1).0, viewers(5).0, viewers(1_000_000).0],
        [Viewers::All; 3]
    );
}

#[test]
fn parents_may_come_later_and_circles_are_cut() {
    let nobody = |_: &mut Common| {};
    let all = vec![
        dummy(1, 3, nobody),
        dummy(2, 9, nobody),
        dummy(3, -1, nobody),
        dummy(4, 5, nobody),
        dummy(5, 4, nobody),
    ];
    let contents = Contents {
        objects: all,
        ..Contents::default()
    };
    let (scene, made) = loaded(file(40_100, 22, contents));
    let parent = |at: usize| {
        let parent = scene.object(made.objects[at]).unwrap().parent();
        parent.and_then(|parent| made.objects.iter().position(|object| *object == parent))
    };
    assert_eq!(
        [parent(0), parent(1), parent(2), parent(3), parent(4)],
        [Some(2), None, None, Some(4), None]
    );
    // The last one that the file gives no parent.
    assert_eq!(made.root, Some(made.objects[2]));
}

#[test]
fn namesakes_come_in_the_order_of_their_numbers() {
    let named = |handle, order, alias: &str| {
        dummy(handle, -1, |common| {
            (common.child_order, common.alias) = (order, Some(alias.into()));
        })
    };
    let all = vec![
        named(1, Some(2), "a"),
        named(2, Some(-1), "b"),
        named(3, Some(0), "a"),
        named(4, Some(1), "a"),
    ];
    let (scene, handles) = objects(41_000, 25, all);
    assert_eq!(scene.roots(), [2, 1, 3, 0].map(|at: usize| handles[at]));
}

fn lists(lists: &[(&str, &[i64])]) -> ReferenceLists {
    lists
        .iter()
        .map(|(tag, list)| ((*tag).to_owned(), list.to_vec()))
        .collect()
}

#[test]
fn references_to_what_is_gone_are_none() {
    let first = dummy(1, -1, |common| {
        common.references = Some(Counted(vec![[109, 2, 0], [109, 7, 0], [109, 0, 0]]));
        common.tagged_references = vec![
            ("t".into(), Counted(vec![0, -1])),
            ("e".into(), Counted(Vec::new())),
        ];
    });
    let all = vec![dummy(0, -1, |_| {}), first, dummy(2, -1, |_| {})];
    let (scene, handles) = objects(41_000, 25, all);
    let raw = |at: usize| handles[at].raw();
    let found = &scene.object(handles[1]).unwrap().references;
    assert_eq!(
        *found,
        lists(&[("", &[raw(2), -1, raw(0)]), ("t", &[raw(0), -1])])
    );
}

#[test]
fn originals_are_found_by_their_identity() {
    let original = |id: Option<&str>| OriginalReference {
        kind: 109,
        handle: 1,
        persistent_id: id.map(Text::from),
    };
    let first = dummy(1, -1, |common| {
        let all = vec![
            original(Some("second")),
            original(Some("gone")),
            original(None),
        ];
        common.original_references = Some(Counted(all));
        common.tagged_original_references = vec![
            ("t".into(), Counted(vec![(5, "second".into())])),
            ("e".into(), Counted(Vec::new())),
        ];
    });
    let second = dummy(2, -1, |common| common.persistent_id = Some("second".into()));
    let (scene, handles) = objects(41_000, 25, vec![first, second]);
    let found = &scene.object(handles[0]).unwrap().original_references;
    let raw = handles[1].raw();
    assert_eq!(*found, lists(&[("", &[raw, -1, -1]), ("t", &[raw])]));
}

#[test]
fn priorities_and_parameters_were_those_of_scripts() {
    let handed_over = |version, params: &str| {
        let own = UserParams {
            params: Some(Counted(vec![("p".into(), "".into(), params.into(), 0)])),
        };
        let script = ScriptChunk {
            ids: Some([0, 1, 1]),
            exec_order: Some(1),
            params: Some(UserParams {
                params: Some(Counted(vec![("p".into(), "".into(), "script".into(), 0)])),
            }),
            ..ScriptChunk::default()
        };
        let owner = dummy(1, -1, |common| {
            common.script_exec_priority = Some(0);
            common.user_params = (!params.is_empty()).then_some(own);
        });
        let contents = Contents {
            objects: vec![owner],
            scripts: vec![script],
            ..Contents::default()
        };
        let (scene, made) = loaded(file(version, 23, contents));
        let object = scene.object(made.objects[0]).unwrap();
        (object.priority, object.user_params[0].1.clone())
    };
    assert_eq!(
        handed_over(40_399, ""),
        (ExecutionPriority::Last, "script".to_owned())
    );
    assert_eq!(
        handed_over(40_400, "own"),
        (ExecutionPriority::First, "own".to_owned())
    );
}

#[test]
fn objects_of_types_that_are_gone_are_dummies_where_they_stood() {
    let pose = Pose::translation(1.0, 2.0, 3.0);
    for class in [Class::Mirror(Box::default()), Class::Unknown(*b"NEW")] {
        let mut gone = object(1, -1, class);
        gone.common.pose = Some(pose.into());
        let object = one_of(41_000, 25, gone);
        assert!(object.dummy().is_ok());
        assert_eq!(object.pose(), pose);
    }
}
