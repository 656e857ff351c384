//! Coverage of one Lua state: instrumented texts, and the lines that ran.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::ffi::CStr;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::probes::with_probes;
use super::text::read_text;
use super::{CountedText, Counts, LineCounts, executable};
use crate::script::lifecycle::instance::Script;
use crate::script::lua::{Stack, Type};
use crate::script::sim::Sim;

/// Texts of one state beyond which nothing is counted: Lua code can name any text.
const MAX_TEXTS: usize = 1000;
/// The tables the probes write to, by chunk name.
const NOTES: &CStr = c"swanilda.coverage";

/// What one state counts.
#[derive(Default)]
pub(crate) struct Coverage {
    texts: RefCell<Vec<Text>>,
    own: RefCell<Option<Own>>,
}

/// A text that is counted.
struct Text {
    chunk_name: Box<[u8]>,
    /// The lines that can run.
    lines: BTreeSet<u32>,
}

/// The script's own text.
struct Own {
    chunk_name: Vec<u8>,
    path: String,
    text: Arc<[u8]>,
}

impl Coverage {
    /// The script's text is going to run under that name.
    pub(super) fn begin(&self, chunk_name: &str, path: String, text: &[u8]) {
        self.own.replace(Some(Own { chunk_name: chunk_name.into(), path, text: text.into() }));
    }

    /// Inserts probes into the function on top, which was just compiled, if its text is counted.
    pub(crate) fn count_function(&self, stack: Stack<'_>) {
        let Some(chunk_name) = stack.chunk_name_of_function() else { return };
        let Some(lines) = self.lines_of(&chunk_name) else { return };
        stack.push_value(-1);
        let Some((bytecode, upvalue)) = with_probes(&stack.dump(), &lines) else { return };
        push_notes(stack, &chunk_name);
        stack.replace_function(&bytecode, i32::from(upvalue));
    }

    /// The lines that can run of the text with that name; None when it is not counted.
    fn lines_of(&self, chunk_name: &[u8]) -> Option<BTreeSet<u32>> {
        let mut texts = self.texts.borrow_mut();
        if let Some(known) = texts.iter().find(|text| *text.chunk_name == *chunk_name) {
            return Some(known.lines.clone());
        }
        if texts.len() >= MAX_TEXTS {
            return None;
        }
        let own = self.own.borrow();
        let text = match own.as_ref().filter(|own| own.chunk_name == chunk_name) {
            Some(own) => own.text.to_vec(),
            None => read_text(Path::new(&*String::from_utf8_lossy(chunk_name.strip_prefix(b"@")?)))?,
        };
        let functions = executable(&text).unwrap_or_default();
        let lines: BTreeSet<u32> = functions.into_iter().flat_map(|function| function.lines).collect();
        texts.push(Text { chunk_name: chunk_name.into(), lines: lines.clone() });
        Some(lines)
    }

    /// Returns the recorded lines and starts over.
    pub(super) fn take(&self, sim: &Sim, script: &Script, stack: Stack<'_>) -> LineCounts {
        let mut all = LineCounts::default();
        let own = self.own.borrow();
        for text in self.texts.borrow().iter() {
            let counted = match own.as_ref().filter(|own| *own.chunk_name == *text.chunk_name) {
                Some(own) => own.counted(sim, script),
                None => CountedText::File(PathBuf::from(String::from_utf8_lossy(&text.chunk_name[1..]).into_owned())),
            };
            all.add(counted, &text.take_notes(stack));
        }
        all
    }
}

impl Text {
    /// 1 for each line that has run since the last time.
    fn take_notes(&self, stack: Stack<'_>) -> Counts {
        let mut counts = vec![0; self.lines.last().map_or(0, |&line| line as usize)];
        let top = stack.top();
        push_notes(stack, &self.chunk_name);
        let notes = stack.top();
        for &line in &self.lines {
            let name = line.to_string();
            let is_noted = stack.raw_get_field(notes, &name) != Type::Nil
                || stack.raw_get_index(notes, i64::from(line)) != Type::Nil;
            stack.set_top(notes);
            if is_noted {
                counts[line as usize - 1] = 1;
                stack.push_nil();
                stack.raw_set_field(notes, &name);
                stack.push_nil();
                stack.raw_set_index(notes, i64::from(line));
            }
        }
        stack.set_top(top);
        counts
    }
}

/// Pushes the table that the probes of a text write to.
fn push_notes(stack: Stack<'_>, chunk_name: &[u8]) {
    let name = String::from_utf8_lossy(chunk_name);
    if stack.push_registry(NOTES) != Type::Table {
        stack.pop(1);
        stack.new_table(0, 1);
        stack.push_value(-1);
        stack.set_registry(NOTES);
    }
    if stack.raw_get_field(-1, &name) != Type::Table {
        stack.pop(1);
        stack.new_table(0, 0);
        stack.push_value(-1);
        stack.raw_set_field(-3, &name);
    }
    stack.remove(-2);
}

impl Own {
    fn counted(&self, sim: &Sim, script: &Script) -> CountedText {
        let path = sim.path_of_script(script).unwrap_or_else(|| self.path.clone());
        CountedText::Script { scene: sim.scene_path(), path, text: Arc::clone(&self.text) }
    }
}
