//! Names from before aliases (spec: vrep-era 1): unique in a scene; a number after `#`, the suffix, distinguishes the copies of a model.

use std::collections::BTreeMap;

use super::companions::Companion;
use super::number_runs::NumberRuns;
use crate::{Field, Handle, Scene, SceneError, SceneResult};

/// Length of the longest name that a script may choose.
const MAX_NAME_BYTES: usize = 127;

/// The names of a scene.
#[derive(Debug, Default)]
pub(crate) struct OldNames {
    handles: BTreeMap<String, Handle>,
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
            self.note_number(&name);
        }
        name
    }

    /// Makes a name available again.
    pub(crate) fn release(&mut self, name: &str) {
        if self.handles.remove(name).is_some() {
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

    /// The smallest suffix that `others` do not use and with which all stems are free, -1 for none.
    fn free_suffix(&self, stems: &[&str], others: impl Fn(i64) -> bool) -> i64 {
        if stems.iter().all(|stem| !self.handles.contains_key(*stem)) && !others(-1) {
            return -1;
        }
        let first = stems
            .iter()
            .map(|stem| self.first_free_suffix(stem))
            .max()
            .unwrap_or(0);
        let is_free = |number: &i64| {
            let mut names = stems.iter().map(|stem| with_suffix(stem, *number));
            let is_known = stems.len() == 1 && *number == first;
            (is_known || names.all(|name| !self.handles.contains_key(&name))) && !others(*number)
        };
        (first..).find(is_free).unwrap_or(first)
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

pub(super) fn with_suffix(stem: &str, number: i64) -> String {
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
    /// smallest with which no name is used twice, not by `companions` either. Returns the new suffixes by the old ones; -1 is none.
    ///
    /// # Errors
    /// When an object does not exist.
    pub fn number_names(
        &mut self,
        group: &[(Handle, String)],
        companions: &[(Companion, String)],
    ) -> SceneResult<BTreeMap<i64, i64>> {
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
        let mut numbers = BTreeMap::new();
        for same in members.chunk_by(|a, b| a.0.0 == b.0.0) {
            let own = same[0].0.0;
            let stems: Vec<&str> = same.iter().map(|((_, stem), _)| *stem).collect();
            let others = |number| self.has_companion(companions, own, number);
            let number = self.old_names.free_suffix(&stems, others);
            for ((_, stem), handle) in same {
                let name = self.old_names.claim(with_suffix(stem, number), *handle);
                self.modify(*handle, Field::Other, |object| object.old_name = name)?;
            }
            numbers.insert(own, number);
        }
        Ok(numbers)
    }

    /// Whether a name that is there is that of one of `companions` with another number instead of `own`.
    fn has_companion(&self, companions: &[(Companion, String)], own: i64, number: i64) -> bool {
        companions.iter().any(|(kind, name)| {
            let (its_own, stem) = suffix(name);
            its_own == own && self.is_companion(*kind, &with_suffix(stem, number))
        })
    }
}

#[cfg(test)]
mod tests;
