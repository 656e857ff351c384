//! Coverage of one Lua state: instrumented texts, and the lines that ran.
//!
//! `executable` determines which lines can run. When a text is loaded, probes are inserted into its bytecode, which record the lines that run.
//! A line counts once for each state that has run it.

mod executable;

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::ffi::{CStr, c_int};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::startup::load_module;
use crate::coverage::{CountedText, Counts, LineCounts, read_text};
use crate::host::{Script, Sim, SourceText};
use crate::lua::{LuaError, Stack, Type, push_callback};
pub use executable::executable;

/// Maximum number of texts per state: Lua code can use any number of names.
const MAX_TEXTS: usize = 1000;
/// Registry key of the tables that the probes write to, by chunk name.
const NOTES: &CStr = c"swanilda.coverage";

/// The coverage of one state; application data of that state.
#[derive(Default)]
pub(super) struct Coverage {
    texts: RefCell<Vec<Text>>,
    own: RefCell<Option<Own>>,
}

/// A text whose lines are counted.
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

/// Counts the lines of every text that a state loads from now on.
pub(super) fn install(sim: &Sim, stack: Stack<'_>) -> Result<(), LuaError> {
    stack.lua().set_app_data(Coverage::default());
    load_module(stack, sim, "loaders")?;
    push_callback(stack, count, 0);
    stack.push_bytes(b"(coverage)");
    stack.protected_call(2, 0)
}

/// Instruments a function that was just loaded.
fn count(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    stack.set_top(1);
    if let Some(coverage) = stack.lua().app_data_ref::<Coverage>() {
        coverage.count_function(stack);
    }
    Ok(1)
}

/// Instruments the script's own text, whose function is on top of the stack. Reports call it `path`.
pub(super) fn begin(stack: Stack<'_>, source: &SourceText<'_>, path: &str) {
    if let Some(coverage) = stack.lua().app_data_ref::<Coverage>() {
        let (chunk_name, text) = (source.chunk_name.into(), source.text.into());
        coverage.own.replace(Some(Own {
            chunk_name,
            path: path.to_owned(),
            text,
        }));
        coverage.count_function(stack);
    }
}

impl Coverage {
    /// Inserts probes into the function on top, which was just compiled, if its text is counted.
    fn count_function(&self, stack: Stack<'_>) {
        let Some(chunk_name) = stack.chunk_name_of_function() else {
            return;
        };
        let Some(lines) = self.lines_of(&chunk_name) else {
            return;
        };
        stack.push_value(-1);
        let Some(instrumented) = stack
            .dump()
            .and_then(|bytecode| bytecode.with_probes(&lines))
        else {
            return;
        };
        push_notes(stack, &chunk_name);
        stack.replace_function(&instrumented);
    }

    /// The lines that can run in the text with that name; None if it is not counted.
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
            None => read_text(Path::new(&*String::from_utf8_lossy(
                chunk_name.strip_prefix(b"@")?,
            )))?,
        };
        let functions = executable(&text).unwrap_or_default();
        let lines: BTreeSet<u32> = functions
            .into_iter()
            .flat_map(|function| function.lines)
            .collect();
        texts.push(Text {
            chunk_name: chunk_name.into(),
            lines: lines.clone(),
        });
        Some(lines)
    }

    /// Returns the recorded lines and starts over.
    pub(super) fn take(&self, sim: &Sim, stack: Stack<'_>) -> LineCounts {
        let mut all = LineCounts::default();
        let own = self.own.borrow();
        for text in self.texts.borrow().iter() {
            let counted = match own
                .as_ref()
                .filter(|own| *own.chunk_name == *text.chunk_name)
            {
                Some(own) => own.counted(sim, &stack.env().script),
                None => CountedText::File(PathBuf::from(
                    String::from_utf8_lossy(&text.chunk_name[1..]).into_owned(),
                )),
            };
            all.add(counted, &text.take_notes(stack));
        }
        all
    }
}

impl Text {
    /// 1 for each line that has run since the last call.
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
        let path = sim
            .path_of_script(script)
            .unwrap_or_else(|| self.path.clone());
        CountedText::Script {
            scene: sim.scene_path(),
            path,
            text: self.text.to_vec(),
        }
    }
}
