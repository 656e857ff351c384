//! Rooms stand on each other without circles, and methods of a shared type are used downwards only.

use std::collections::{BTreeMap, BTreeSet};

use super::imports::{
    code_lines, is_test, module_path, read, sources, without_tests, without_texts,
};
use super::rules::{CIRCLES, ROOMS, Rooms, SHARED_TYPE};

#[test]
fn no_room_stands_on_itself() {
    for (name, rooms) in ROOMS {
        let is_excused = CIRCLES.iter().any(|(of, _)| of == name);
        let circle = without_ground(rooms);
        assert_eq!(
            !circle.is_empty(),
            is_excused,
            "{name}: these use each other: {circle:#?}"
        );
    }
}

/// What is left when all rooms are taken away whose uses are gone: rooms in circles, and those above them.
fn without_ground(rooms: Rooms) -> BTreeMap<&'static str, BTreeSet<&'static str>> {
    let with_uses = rooms
        .iter()
        .map(|(room, used)| (*room, used.iter().copied().collect()));
    let mut left: BTreeMap<&str, BTreeSet<&str>> = with_uses.collect();
    while let Some(ground) = left
        .iter()
        .find(|(_, used)| used.is_empty())
        .map(|(room, _)| *room)
    {
        left.remove(ground);
        for used in left.values_mut() {
            used.remove(ground);
        }
    }
    left
}

/// A method of the simulator stands in the room of its matter, where only rooms above may call it. Only names that the crate defines once
/// say whose method is called.
#[test]
fn methods_are_called_from_above() {
    let (layer, of) = SHARED_TYPE;
    let (_, rooms) = ROOMS
        .iter()
        .find(|(name, _)| *name == layer)
        .expect("the crate consists of rooms");
    let files = files_of(layer);
    let homes = homes_of_methods(&files, of);
    assert!(homes.len() > 100, "the simulator has methods");
    let wrong: BTreeSet<String> = files
        .iter()
        .flat_map(|(room, text)| forbidden_calls(rooms, &homes, room, text))
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// The rooms of a crate with the code of their files.
fn files_of(layer: &str) -> Vec<(String, String)> {
    let files = sources().into_iter().filter(|file| !is_test(file));
    files
        .filter_map(|file| match module_path(&file).as_slice() {
            [of, room, ..] if of == layer => Some((room.clone(), code(&read(&file)))),
            _ => None,
        })
        .collect()
}

/// The methods of rooms that a room may not use, where it calls them.
fn forbidden_calls(
    rooms: Rooms,
    homes: &BTreeMap<String, String>,
    room: &str,
    text: &str,
) -> Vec<String> {
    let (_, may_use) = rooms
        .iter()
        .find(|(of, _)| *of == room)
        .expect("another test says which rooms there are");
    let called = called(text).filter_map(|name| Some((name, homes.get(name)?)));
    called
        .filter(|(_, home)| *home != room && !may_use.contains(&home.as_str()))
        .map(|(name, home)| format!("{room} must not call `{name}` of {home}"))
        .collect()
}

fn code(text: &str) -> String {
    let text = without_tests(text);
    let lines: Vec<_> = code_lines(&text).map(without_texts).collect();
    lines.join("\n")
}

/// The rooms of the methods of `of` that no other function of the crate shares its name with.
fn homes_of_methods(files: &[(String, String)], of: &str) -> BTreeMap<String, String> {
    let mut defined: BTreeMap<String, usize> = BTreeMap::new();
    let mut homes = BTreeMap::new();
    let begin = format!("impl {of} {{");
    for (room, text) in files {
        let mut in_type = false;
        for line in text.lines() {
            if !line.is_empty() && !line.starts_with([' ', '}']) {
                in_type = line == begin;
            }
            if let Some(name) = defines(line) {
                *defined.entry(name.to_owned()).or_default() += 1;
                if in_type {
                    homes.insert(name.to_owned(), room.clone());
                }
            }
        }
    }
    homes.retain(|name, _| defined.get(name) == Some(&1));
    homes
}

/// The name of the function that a line begins.
fn defines(line: &str) -> Option<&str> {
    let (before, after) = line.split_once("fn ")?;
    let is_definition = before.split_whitespace().all(|word| {
        word.starts_with("pub") || ["const", "unsafe", "extern", "safe"].contains(&word)
    });
    let end = after.find(|c: char| !c.is_alphanumeric() && c != '_')?;
    (is_definition && end > 0).then_some(&after[..end])
}

/// The names of methods that are called.
fn called(text: &str) -> impl Iterator<Item = &str> {
    text.split('.').skip(1).filter_map(|rest| {
        let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_')?;
        rest[end..].starts_with('(').then_some(&rest[..end])
    })
}
