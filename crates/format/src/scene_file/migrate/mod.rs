//! Updates the text of old scripts as CoppeliaSim does when it loads older files (spec: scene-files 7.3).
//!
//! All of it works on the text, not on Lua: comments and strings are rewritten alike, as in the original. Line numbers stay, save
//! where functions are put in front.

mod keywords;
pub mod old_names;
mod poses;
mod preludes;
mod texts;
mod threads;

use crate::ttt::Header;

/// Where a script comes from.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Origin {
    /// The program that wrote it, 40100 is 4.1.0; 0 for one that is older than any.
    pub version: u16,
    /// It ran in a thread of its own.
    pub thread: Option<Thread>,
    /// It was written for the way scripts were called before 3.1.3.
    pub before_calls: bool,
    /// ... in the sensing phase.
    pub in_sensing: bool,
    /// It was written before 3.1.4, when colours had another meaning.
    pub old_colours: bool,
}

/// Behaviour at the end of a thread.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Thread {
    Once,
    Again,
}

/// Scripts are called by handle only since.
const CALLS_BY_HANDLE: u16 = 40800;
/// Scripts are in Lua 5.3 since, then 5.4.
const LUA_5_3: u16 = 40200;
/// The scripts of threads have been coroutines since.
const COROUTINES: u16 = 40200;

impl Origin {
    /// Of a file with that header.
    pub fn of(header: &Header) -> Self {
        Self {
            version: header.version,
            ..Self::default()
        }
    }

    /// Of a text nothing is known of: whatever was there since V-REP may be in it.
    pub fn unknown() -> Self {
        Self {
            thread: Some(Thread::Once),
            ..Self::default()
        }
    }

    fn is_before(&self, version: u16) -> bool {
        self.version < version
    }
}

/// The text of a Lua file that comes from no scene, as if a scene of the time of V-REP had it: all names and meanings are replaced that
/// ever were.
pub fn with_compat(code: Vec<u8>) -> Vec<u8> {
    lua(code, &Origin::unknown())
}

/// The text converted to the present version. A text without old code is returned unchanged.
pub(crate) fn lua(code: Vec<u8>, origin: &Origin) -> Vec<u8> {
    // Names are ASCII; whatever encoding a comment has, its bytes come back as they were.
    let text: String = code.iter().copied().map(char::from).collect();
    let new = migrate(&text, origin);
    if new == text {
        code
    } else {
        new.chars().map(|c| c as u8).collect()
    }
}

fn migrate(text: &str, origin: &Origin) -> String {
    let mut text = old_names::replace(text, |word| old_names::since(word, origin.version));
    if origin.is_before(CALLS_BY_HANDLE) {
        text = texts::calls_by_type(&text);
    }
    if origin.is_before(LUA_5_3) {
        text = keywords::goto_as_name(&text);
    }
    if origin.is_before(30300) {
        text = text.replace('\t', "    ");
    }
    if origin.is_before(30401) {
        text = texts::dialog_attributes(&text);
    }
    if origin.old_colours {
        text = texts::colours(&text);
    }
    if origin.is_before(40001) {
        text = poses::relative_to_joints(&text);
    }
    if origin.is_before(COROUTINES) {
        text = texts::own_object(&text);
        text = texts::end_of_simulation(&text);
    }
    let text = in_its_form(text, origin);
    if origin.is_before(LUA_5_3) {
        return preludes::truncating_format(&preludes::setup_of_planning(&text));
    }
    text
}

/// The text with the callbacks that scripts have since.
fn in_its_form(text: String, origin: &Origin) -> String {
    match origin.thread {
        Some(_) if is_empty(&text) => text,
        Some(thread) if origin.is_before(COROUTINES) => {
            threads::coroutine(&text, thread, origin.version == 0)
        }
        None if origin.before_calls && !is_empty(&text) => {
            texts::called_each_step(&text, origin.in_sensing)
        }
        _ => text,
    }
}

fn is_empty(text: &str) -> bool {
    text.trim().is_empty()
}
