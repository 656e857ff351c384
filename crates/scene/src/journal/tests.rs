//! Readers of different speeds.

use super::*;
use crate::object::dummy::Dummy;
use crate::{Kind, Pose, Scene};

const POSES: Topics = Topics::NONE.with_fields(&[Field::Pose]);

fn moved(handle: u32) -> Change {
    Change::Modified(Handle(handle), Field::Pose)
}

/// A journal with room for `limit` changes, and a cursor that knows all of it.
fn journal(limit: usize, topics: Topics) -> (Journal, Cursor) {
    let journal = Journal::with_limit(limit);
    let cursor = follower(&journal, topics);
    (journal, cursor)
}

fn follower(journal: &Journal, topics: Topics) -> Cursor {
    let mut cursor = journal.follow(topics);
    journal.skip(&mut cursor);
    cursor
}

/// Changes read by the cursor; None for `Unread::Everything`.
fn read(journal: &Journal, cursor: &mut Cursor) -> Option<Vec<Change>> {
    match journal.read(cursor) {
        Unread::Everything => None,
        Unread::Changes(changes) => Some(changes.cloned().collect()),
    }
}

fn scene_with_dummy() -> (Scene, Handle) {
    let mut scene = Scene::new();
    let dummy = scene
        .add("d", Kind::Dummy(Dummy::new(0.01)))
        .expect("there is room");
    (scene, dummy)
}

#[test]
fn for_a_new_reader_everything_may_have_changed() {
    let mut journal = Journal::default();
    journal.note(moved(1));
    let mut cursor = journal.follow(Topics::ALL);
    journal.note(moved(2));
    assert_eq!(read(&journal, &mut cursor), None);
    assert_eq!(read(&journal, &mut cursor), Some(vec![]));
    journal.note(moved(3));
    assert_eq!(read(&journal, &mut cursor), Some(vec![moved(3)]));
}

#[test]
fn two_readers_have_places_of_their_own() {
    let (mut journal, mut first) = journal(1000, Topics::ALL);
    journal.note(moved(1));
    let mut second = follower(&journal, Topics::ALL);
    journal.note(moved(2));
    assert_eq!(read(&journal, &mut first), Some(vec![moved(1), moved(2)]));
    journal.note(moved(3));
    assert_eq!(read(&journal, &mut second), Some(vec![moved(2), moved(3)]));
    assert_eq!(read(&journal, &mut first), Some(vec![moved(3)]));
}

#[test]
fn a_reader_gets_only_what_it_asked_for() {
    let (mut journal, mut all) = journal(1000, Topics::ALL);
    let mut poses = follower(&journal, POSES);
    journal.note(Change::Selection);
    journal.note(moved(1));
    journal.note(Change::Settings);
    assert_eq!(read(&journal, &mut poses), Some(vec![moved(1)]));
    let Unread::Changes(changes) = journal.read(&mut all) else {
        panic!("nothing was lost")
    };
    assert!(
        changes
            .rev()
            .eq(&[Change::Settings, moved(1), Change::Selection])
    );
}

#[test]
fn nothing_is_stored_that_nobody_reads() {
    let mut journal = Journal::default();
    journal.note(moved(1));
    assert_eq!(journal.stored(), 0);
    let mut cursor = follower(&journal, POSES);
    journal.note(Change::Selection);
    assert_eq!(journal.stored(), 0);
    for handle in 0..100_000 {
        journal.note(moved(handle));
        assert_eq!(
            read(&journal, &mut cursor).map(|changes| changes.len()),
            Some(1)
        );
        assert!(journal.stored() <= 64, "what was read goes");
    }
}

#[test]
fn a_reader_that_is_gone_holds_nothing() {
    let (mut journal, mut there) = journal(100_000, POSES);
    let gone = journal.follow(Topics::ALL);
    journal.note(Change::Selection);
    assert_eq!(journal.stored(), 1);
    drop(gone);
    for handle in 0..1000 {
        journal.note(moved(handle));
        journal.skip(&mut there);
    }
    assert!(journal.stored() <= 64);
    assert!(!journal.is_followed(Topic::Selection));
    drop(there);
    (0..1000).for_each(|handle| journal.note(moved(handle)));
    assert_eq!(journal.stored(), 0);
}

#[test]
fn a_reader_too_far_behind_gets_everything_and_continues_from_there() {
    let (mut journal, mut slow) = journal(100, Topics::ALL);
    let mut quick = follower(&journal, Topics::ALL);
    for handle in 0..1000 {
        journal.note(moved(handle));
        assert!(journal.stored() <= 100);
        if handle % 40 == 39 {
            assert_eq!(
                read(&journal, &mut quick).map(|changes| changes.len()),
                Some(40),
                "at {handle}"
            );
        }
    }
    assert_eq!(read(&journal, &mut slow), None);
    journal.note(moved(7));
    assert_eq!(read(&journal, &mut slow), Some(vec![moved(7)]));
    assert_eq!(read(&journal, &mut quick), Some(vec![moved(7)]));
}

#[test]
fn a_reader_of_another_scene_gets_everything() {
    let (_, mut cursor) = journal(1000, Topics::ALL);
    let mut mark = Mark::new(Topics::ALL);
    assert!(Journal::default().changed_since(&mut mark));
    let mut other = Journal::default();
    assert!(
        other.changed_since(&mut mark),
        "it has no changes either, but is another one"
    );
    assert_eq!(read(&other, &mut cursor), None);
    other.note(moved(1));
    assert_eq!(read(&other, &mut cursor), Some(vec![moved(1)]));
}

#[test]
fn changes_made_while_reading_are_read_next_time() {
    let (mut scene, dummy) = scene_with_dummy();
    let mut cursor = follower(scene.journal(), POSES);
    scene
        .set_local_pose(dummy, Pose::translation(1.0, 0.0, 0.0))
        .unwrap();
    let found = read(scene.journal(), &mut cursor).expect("nothing was lost");
    for change in &found {
        assert_eq!(*change, moved(dummy.0));
        scene
            .set_local_pose(dummy, Pose::translation(2.0, 0.0, 0.0))
            .unwrap();
    }
    assert_eq!(read(scene.journal(), &mut cursor).as_ref(), Some(&found));
    assert_eq!(read(scene.journal(), &mut cursor), Some(vec![]));
}

#[test]
fn the_order_of_changes_distinguishes_uses_of_a_handle() {
    let (mut scene, first) = scene_with_dummy();
    let mut cursor = follower(scene.journal(), Topics::TREE);
    let uid = scene.object(first).unwrap().uid();
    scene.remove(&[first]).unwrap();
    scene.objects.start_handles_at(first);
    let second = scene.add("e", Kind::Dummy(Dummy::new(0.01))).unwrap();
    assert_eq!(second, first);
    let expected = vec![Change::Removed(first, uid), Change::Added(first)];
    assert_eq!(read(scene.journal(), &mut cursor), Some(expected));
}

#[test]
fn a_mark_knows_what_it_was_asked_about() {
    let (mut scene, dummy) = scene_with_dummy();
    let mut tree = Mark::new(Topics::TREE);
    assert!(scene.journal().changed_since(&mut tree));
    assert!(!scene.journal().changed_since(&mut tree));
    scene
        .set_local_pose(dummy, Pose::translation(1.0, 0.0, 0.0))
        .unwrap();
    assert!(!scene.journal().changed_since(&mut tree));
    scene.remove(&[dummy]).unwrap();
    assert!(scene.journal().changed_since(&mut tree));
    assert_eq!(
        scene.journal().counters(),
        Counters {
            creations: 1,
            destructions: 1,
            hierarchy: 2
        }
    );
}

#[test]
fn data_written_often_is_one_name() {
    let mut journal = Journal::default();
    let object = Holder::Object(Handle(3));
    for _ in 0..10 {
        journal.note_stored(object, Namespace::Signal, &Edited::Written("x"));
    }
    journal.note_stored(object, Namespace::Signal, &Edited::Removed("x"));
    journal.note_stored(Holder::Scene, Namespace::Signal, &Edited::Written("y"));
    let names = ChangedNames::from([("x".to_owned(), false)]);
    assert!(
        journal
            .take_changed_data()
            .into_iter()
            .eq([((Handle(3), Namespace::Signal), names)])
    );
    assert!(journal.take_changed_data().is_empty());
}
