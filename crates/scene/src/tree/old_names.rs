//! Names from before aliases (spec: vrep-era 1): unique in a scene; a number after `#`, the suffix, distinguishes the copies of a model.

use std::collections::BTreeMap;

use super::number_runs::NumberRuns;
use crate::{Field, Handle, Scene, SceneError, SceneResult};

/// Length of the longest name that a script may choose.
const MAX_NAME_BYTES: usize = 127;

/// The names of a scene.
#[derive(Debug, Default)]
pub(crate) struct OldNames {
    handles: BTreeMap<String, Handle>,
    /// How many of them have a suffix, -1 for none.
    suffixes: BTreeMap<i64, usize>,
    /// The numbers at the ends of names, by what is before them.
    numbers: BTreeMap<String, NumberRuns>,
}

impl OldNames {
    /// Reserves a name for an object: the one that is asked for, or the next free number at its end.
    pub(crate) fn claim(&mut self, wished: String, handle: Handle) -> String {
        let name = if self.handles.contains_key(&wished) {
            self.next_free(&wished)
        } else {
            wished
        };
        if self.handles.insert(name.clone(), handle).is_none() {
            *self.suffixes.entry(suffix(&name).0).or_default() += 1;
            self.note_number(&name);
        }
        name
    }

    /// Makes a name available again.
    pub(crate) fn release(&mut self, name: &str) {
        if self.handles.remove(name).is_some() {
            self.forget_suffix(suffix(name).0);
            self.forget_number(name);
        }
    }

    fn note_number(&mut self, name: &str) {
        let Some((stem, number)) = written_number(name) else {
            return;
        };
        if let Some(numbers) = self.numbers.get_mut(stem) {
            return numbers.insert(number);
        }
        let mut numbers = NumberRuns::default();
        numbers.insert(number);
        self.numbers.insert(stem.to_owned(), numbers);
    }

    fn forget_number(&mut self, name: &str) {
        let Some((stem, number)) = written_number(name) else {
            return;
        };
        if let Some(numbers) = self.numbers.get_mut(stem) {
            numbers.remove(number);
            if numbers.is_empty() {
                self.numbers.remove(stem);
            }
        }
    }

    fn forget_suffix(&mut self, suffix: i64) {
        if let Some(count) = self.suffixes.get_mut(&suffix) {
            *count -= 1;
            if *count == 0 {
                self.suffixes.remove(&suffix);
            }
        }
    }

    fn next_free(&self, taken: &str) -> String {
        let (stem, own) = split_number(taken);
        let begin = own.map_or(0, |own| own.saturating_add(1));
        format!("{stem}{}", self.free_number(stem, begin))
    }

    /// The first number from `begin` on that makes a free name of a stem.
    fn free_number(&self, stem: &str, begin: u64) -> u64 {
        let numbers = self.numbers.get(stem);
        numbers.map_or(begin, |numbers| numbers.first_free(begin))
    }

    /// The first suffix with which a stem is free.
    fn first_free_suffix(&self, stem: &str) -> i64 {
        self.free_number(&[stem, "#"].concat(), 0) as i64
    }

    /// The smallest suffix with which all stems are free, up to `limit`, with which they are.
    fn free_suffix(&self, stems: &[&str], limit: i64) -> i64 {
        if stems.iter().all(|stem| !self.handles.contains_key(*stem)) {
            return -1;
        }
        let first = stems
            .iter()
            .map(|stem| self.first_free_suffix(stem))
            .max()
            .unwrap_or(0);
        let is_free = |number: &i64| {
            stems.len() == 1
                || stems
                    .iter()
                    .all(|stem| !self.handles.contains_key(&with_suffix(stem, *number)))
        };
        (first..limit).find(is_free).unwrap_or(limit)
    }

    /// The largest suffix in use; -1 if there is none.
    fn highest_suffix(&self) -> i64 {
        self.suffixes
            .last_key_value()
            .map_or(-1, |(&suffix, _)| suffix)
    }
}

/// A name without the number at its end, and that number.
fn split_number(name: &str) -> (&str, Option<u64>) {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    (stem, name[stem.len()..].parse().ok())
}

/// The same for a name that ends in a number as it is written here: without zeros in front.
fn written_number(name: &str) -> Option<(&str, u64)> {
    let (stem, number) = split_number(name);
    let digits = &name[stem.len()..];
    let is_plain = digits == "0" || !digits.starts_with('0');
    number.filter(|_| is_plain).map(|number| (stem, number))
}

/// The name, or what is before its last digits with the first free number.
pub(super) fn free_name(name: String, is_taken: impl Fn(&str) -> bool) -> String {
    if !is_taken(&name) {
        return name;
    }
    let (stem, number) = split_number(&name);
    let mut names = (number.map_or(0, |number| number.saturating_add(1))..=u64::MAX)
        .map(|n| format!("{stem}{n}"));
    names.find(|name| !is_taken(name)).unwrap_or(name)
}

/// The number after the `#` of a name, -1 without one, and what is before it.
pub fn suffix(name: &str) -> (i64, &str) {
    let Some((stem, number)) = name.rsplit_once('#') else {
        return (-1, name);
    };
    match number.parse::<u32>() {
        Ok(number) => (number.into(), stem),
        Err(_) if number.is_empty() => (-1, stem),
        Err(_) => (-1, name),
    }
}

fn with_suffix(stem: &str, number: i64) -> String {
    if number < 0 {
        stem.to_owned()
    } else {
        format!("{stem}#{number}")
    }
}

/// Whether a script may choose this name.
pub fn is_legal(name: &str) -> bool {
    let (stem, number) = name
        .split_once('#')
        .map_or((name, None), |(stem, number)| (stem, Some(number)));
    let is_word = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '(' | ')');
    let is_number = |text: &str| {
        !text.is_empty()
            && text.bytes().all(|c| c.is_ascii_digit())
            && (text == "0" || !text.starts_with('0'))
    };
    !stem.is_empty()
        && name.len() <= MAX_NAME_BYTES
        && stem.chars().all(is_word)
        && number.is_none_or(is_number)
}

/// The name with words for all signs that were illegal before V-REP 2.3.
pub fn alternative_name(name: &str) -> String {
    let signs = [
        ('#', "_HASHMARK_"),
        ('-', "_MINUSMARK_"),
        ('(', "_OPARENTHESISMARK_"),
        (')', "_CPARENTHESISMARK_"),
    ];
    let word = |c: char| match signs.iter().find(|(sign, _)| *sign == c) {
        Some((_, word)) => (*word).to_owned(),
        None if c.is_ascii_alphanumeric() => c.to_string(),
        None => "_".to_owned(),
    };
    name.chars().map(word).collect()
}

impl Scene {
    /// Renames an object for functions from before aliases. Where the name is taken, the next number replaces the one at its end.
    ///
    /// # Errors
    /// When there is no such object.
    pub fn set_old_name(&mut self, handle: Handle, name: &str) -> SceneResult<()> {
        let name = self.claim_old_name(handle, name)?;
        self.modify(handle, Field::Other, |object| object.old_name = name)
    }

    /// Reserves a name in place of the present one.
    pub(super) fn claim_old_name(&mut self, handle: Handle, name: &str) -> SceneResult<String> {
        let previous = self.object(handle)?.old_name().to_owned();
        self.old_names.release(&previous);
        Ok(self.old_names.claim(name.to_owned(), handle))
    }

    /// The same for a name that must be legal and unused.
    ///
    /// # Errors
    /// When it is not, or there is no such object.
    pub fn rename(&mut self, handle: Handle, name: &str) -> SceneResult<()> {
        if self.object(handle)?.old_name() == name {
            return Ok(());
        }
        if !is_legal(name) || self.old_names.handles.contains_key(name) {
            return Err(SceneError::IllegalName);
        }
        self.set_old_name(handle, name)
    }

    /// The object with that name.
    ///
    /// # Errors
    /// When there is none.
    pub fn find_old_name(&self, name: &str) -> SceneResult<Handle> {
        self.old_names
            .handles
            .get(name)
            .copied()
            .ok_or(SceneError::NoSuchPath)
    }

    /// The object with that alternative name.
    ///
    /// # Errors
    /// When there is none.
    pub fn find_alternative_name(&self, name: &str) -> SceneResult<Handle> {
        let mut names = self.old_names.handles.iter();
        let found = names.find(|(known, _)| alternative_name(known) == name);
        found
            .map(|(_, handle)| *handle)
            .ok_or(SceneError::NoSuchPath)
    }

    /// Renames the objects of a model that was added, given their names in the model: all of one suffix get the same other suffix, the
    /// smallest with which no name is used twice.
    ///
    /// # Errors
    /// When an object does not exist.
    pub fn number_names(&mut self, group: &[(Handle, String)]) -> SceneResult<()> {
        for (handle, _) in group {
            // A copy has none yet.
            let name = self.objects.get(*handle)?.old_name();
            if !name.is_empty() {
                self.old_names.release(name);
            }
        }
        let mut members: Vec<_> = group
            .iter()
            .map(|(handle, name)| (suffix(name), *handle))
            .collect();
        members.sort_by_key(|((own, _), _)| *own);
        let lowest = members.first().map_or(-1, |((own, _), _)| *own);
        let offset = self.old_names.highest_suffix() - lowest + 1;
        for same in members.chunk_by(|a, b| a.0.0 == b.0.0) {
            let stems: Vec<&str> = same.iter().map(|((_, stem), _)| *stem).collect();
            let number = self.old_names.free_suffix(&stems, same[0].0.0 + offset);
            for ((_, stem), handle) in same {
                let name = self.old_names.claim(with_suffix(stem, number), *handle);
                self.modify(*handle, Field::Other, |object| object.old_name = name)?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Kind;
    use crate::object::dummy::Dummy;

    fn add(scene: &mut Scene, name: &str) -> Handle {
        let handle = scene
            .add("dummy", Kind::Dummy(Dummy::new(0.01)))
            .expect("there is room");
        scene.set_old_name(handle, name).expect("it exists");
        handle
    }

    fn name(scene: &Scene, handle: Handle) -> String {
        scene
            .object(handle)
            .expect("it exists")
            .old_name()
            .to_owned()
    }

    #[test]
    fn created_objects_get_the_next_number() {
        let mut scene = Scene::new();
        let made: Vec<Handle> = (0..3).map(|_| add(&mut scene, "dummy")).collect();
        assert_eq!(
            made.iter().map(|&h| name(&scene, h)).collect::<Vec<_>>(),
            ["dummy", "dummy0", "dummy1"]
        );
        scene.remove(&[made[1]]).expect("it exists");
        let next = add(&mut scene, "dummy");
        assert_eq!(name(&scene, next), "dummy0");
        let arm = [add(&mut scene, "arm7"), add(&mut scene, "arm7")];
        assert_eq!(name(&scene, arm[1]), "arm8");
        let padded = ["arm09", "arm9", "arm8", "arm09"].map(|name| add(&mut scene, name));
        let padded = padded.map(|handle| name(&scene, handle));
        assert_eq!(padded, ["arm09", "arm9", "arm10", "arm11"]);
    }

    #[test]
    fn models_are_numbered_as_a_whole() {
        let mut scene = Scene::new();
        for expected in [
            ["bot", "bot_motor"],
            ["bot#0", "bot_motor#0"],
            ["bot#1", "bot_motor#1"],
        ] {
            let names = ["bot", "bot_motor"];
            let group: Vec<_> = names
                .iter()
                .map(|name| (add(&mut scene, name), (*name).to_owned()))
                .collect();
            scene.number_names(&group).expect("they exist");
            assert_eq!([0, 1].map(|at| name(&scene, group[at].0)), expected);
        }
        assert!(scene.find_old_name("bot_motor#1").is_ok());
    }

    #[test]
    fn copies_of_a_model_get_the_smallest_number_with_which_all_names_are_free() {
        let mut scene = Scene::new();
        let copy = |scene: &mut Scene| {
            let group: Vec<_> = ["bot", "motor"]
                .map(|name| (add(scene, "copy"), name.to_owned()))
                .into();
            scene.number_names(&group).expect("they exist");
            group
                .into_iter()
                .map(|(handle, _)| handle)
                .collect::<Vec<_>>()
        };
        let copies: Vec<_> = (0..5).map(|_| copy(&mut scene)).collect();
        assert_eq!(name(&scene, copies[4][1]), "motor#3");
        scene.remove(&copies[2]).expect("they exist");
        scene.remove(&copies[3][..1]).expect("it exists");
        let next = [copy(&mut scene), copy(&mut scene)].map(|copy| name(&scene, copy[0]));
        assert_eq!(next, ["bot#1", "bot#4"]);
        let alone = add(&mut scene, "copy");
        scene
            .number_names(&[(alone, "bot#7".to_owned())])
            .expect("it exists");
        assert_eq!(name(&scene, alone), "bot#2");
    }

    #[test]
    fn suffixes_are_split() {
        assert_eq!(
            [suffix("arm#12"), suffix("arm12"), suffix("arm#")],
            [(12, "arm"), (-1, "arm12"), (-1, "arm")]
        );
    }

    #[test]
    fn illegal_names_are_refused() {
        for name in [
            "",
            "#1",
            "arm#",
            "arm#00",
            "my arm",
            "a#b",
            "a#1#2",
            &"x".repeat(128),
        ] {
            assert!(!is_legal(name), "{name}");
        }
        for name in ["arm", "arm#0", "arm#12", "arm(2)", "a_b", &"x".repeat(127)] {
            assert!(is_legal(name), "{name}");
        }
    }
}
