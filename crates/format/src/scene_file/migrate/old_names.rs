//! Renamed functions and constants.
//!
//! Two tables: names from before the namespaces, as V-REP had them, and names that changed in later versions.

use heap::Lazy;
use std::collections::HashMap;

/// `simGetObjectHandle<TAB>sim.getObjectHandle`, also for constants and functions of plugins. Replaced in files of any version.
const OLD: &str = include_str!("old_names.tsv");
/// `40201<TAB>old<TAB>new`: replaced in files of programs older than that.
const RENAMED: &str = include_str!("renamed.tsv");

static NAMES: Lazy<HashMap<&str, &str>> = Lazy::new(|| {
    OLD.lines()
        .filter_map(|line| line.split_once('\t'))
        .collect()
});

static RENAMES: Lazy<HashMap<&str, (u16, &str)>> = Lazy::new(|| {
    let row = |line: &'static str| {
        let mut columns = line.split('\t');
        let (version, old, new) = (columns.next()?, columns.next()?, columns.next()?);
        Some((old, (version.parse().ok()?, new)))
    };
    RENAMED.lines().filter_map(row).collect()
});

/// The present name for one from before the namespaces.
pub fn current(old: &str) -> Option<&'static str> {
    NAMES.get(old).copied()
}

/// The name that has replaced `word` since `version`. None where it stays.
pub(super) fn since(word: &str, version: u16) -> Option<&'static str> {
    let named = current(word);
    let renamed = RENAMES
        .get(named.unwrap_or(word))
        .filter(|(until, _)| version < *until)
        .map(|(_, new)| *new);
    renamed.or(named)
}

/// Replaces whole words that begin with `sim`: the longest runs of letters, digits, `_` and `.`.
pub(super) fn replace(text: &str, name: impl Fn(&str) -> Option<&'static str>) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find("sim") {
        let word = word_at(&rest[start..]);
        out.push_str(&rest[..start]);
        let is_whole = !out.ends_with(is_part);
        out.push_str(name(word).filter(|_| is_whole).unwrap_or(word));
        rest = &rest[start + word.len()..];
    }
    out + rest
}

fn word_at(text: &str) -> &str {
    &text[..text.find(|c| !is_part(c)).unwrap_or(text.len())]
}

/// Whether a letter may be part of a word.
pub(super) fn is_part(letter: char) -> bool {
    letter.is_ascii_alphanumeric() || letter == '_' || letter == '.'
}

#[cfg(test)]
mod tests {
    use super::{replace, since};

    fn names(text: &str, version: u16) -> String {
        replace(text, |word| since(word, version))
    }

    #[test]
    fn whole_words_are_replaced_everywhere() {
        assert_eq!(
            names("h=simGetObjectHandle('a',sim_handle_all) -- simWait", 40900),
            "h=sim.getObjectHandle('a',sim.handle_all) -- sim.wait"
        );
        for kept in [
            "mysimWait()",
            "simWaitForMe()",
            "sim",
            "a.simWait",
            "é simple",
        ] {
            assert_eq!(names(kept, 40900), kept);
        }
    }

    #[test]
    fn names_change_with_versions() {
        assert_eq!(
            names("simGetBooleanParameter()", 40201),
            "sim.getBoolParameter()"
        );
        assert_eq!(
            names("simGetBooleanParameter()", 40200),
            "sim.getBoolParam()"
        );
        assert_eq!(names("sim.rmlPos()", 40300), "sim.ruckigPos()");
        assert_eq!(names("sim.rmlPos()", 40301), "sim.rmlPos()");
        assert_eq!(
            names("sim.getObjectSelection() simIK.createIkGroup()", 40500),
            "sim.getObjectSel() simIK.createGroup()"
        );
        assert_eq!(names("simPackFloats()", 30302), "sim.packFloatTable()");
        assert_eq!(
            names("sim.childscriptcall_actuation", 30500),
            "sim.syscb_actuation"
        );
        // This one changed its results, so it keeps its name.
        assert_eq!(
            names("sim.getObjectFloatParameter()", 30500),
            "sim.getObjectFloatParameter()"
        );
    }
}
