//! Line coverage of scripts.
//!
//! A state counts the lines of its script's own text and of Lua files that were loaded by name (`@file`), but not those of the simulator's
//! library. A line counts once for each state that has run it. Interpreters count; this module collects their counts. `testing` writes
//! the reports.

mod text;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

pub use text::read_text;

use super::lifecycle::instance::Script;
use super::runtime::Interpreter;
use super::sim::Sim;
use scene::Kind;
use scene::object::script_object::ScriptType;

/// A text whose lines are counted.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum CountedText {
    /// A Lua file, by the name under which it was loaded.
    File(PathBuf),
    /// A script of the scene.
    Script {
        /// The path of the scene's file; empty without one.
        scene: String,
        /// The object's path in the scene.
        path: String,
        /// The text, with bytes as in the scene.
        text: Arc<[u8]>,
    },
}

/// A function of a text.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct FunctionLines {
    /// Its first line; 0 for the main function of the text.
    pub line: u32,
    /// The lines of its body that can run, in the order of the text.
    pub lines: Vec<u32>,
    /// Its name in the text, if it has one.
    pub name: Option<String>,
}

/// The number of states in which each line ran, from line 1. Lines after the last entry never ran.
pub type Counts = Vec<u64>;

/// The counts of many texts.
#[derive(Debug, Clone, Default)]
pub struct LineCounts {
    /// The counts of each text.
    pub texts: BTreeMap<CountedText, Counts>,
    /// The functions of texts whose language says so while they run; those of Lua are found when they are reported.
    pub functions: BTreeMap<CountedText, Vec<FunctionLines>>,
}

impl LineCounts {
    /// Adds the counts of another simulator or state.
    pub fn merge(&mut self, other: Self) {
        other
            .texts
            .into_iter()
            .for_each(|(text, counts)| self.add(text, &counts));
        self.functions.extend(other.functions);
    }

    /// Adds counts of the lines of a text, from line 1, to those that it has.
    pub fn add(&mut self, text: CountedText, counts: &[u64]) {
        let sums = self.texts.entry(text).or_default();
        if sums.len() < counts.len() {
            sums.resize(counts.len(), 0);
        }
        sums.iter_mut()
            .zip(counts)
            .for_each(|(sum, count)| *sum = sum.saturating_add(*count));
    }
}

impl Sim {
    /// Moves the counts of an interpreter to those of the simulator.
    pub(crate) fn collect_line_counts(&self, interpreter: &(impl Interpreter + ?Sized)) {
        if self.options.count_lines
            && let Ok(mut counts) = self.line_counts.try_borrow_mut()
        {
            counts.merge(interpreter.take_line_counts(self));
        }
    }

    /// Returns the counts of all states since the last call. Scripts of the scene that have not run are included without counts.
    pub fn take_line_counts(&self) -> LineCounts {
        let running: Vec<_> = self
            .scripts
            .all()
            .iter()
            .filter_map(|script| script.current_runtime())
            .collect();
        running
            .iter()
            .for_each(|runtime| self.collect_line_counts(&runtime.interpreter));
        let mut counts = self.line_counts.take();
        let idle = self.countable_objects();
        idle.into_iter().for_each(|text| counts.add(text, &[]));
        counts
    }

    fn countable_objects(&self) -> Vec<CountedText> {
        let scene = self.scene.borrow();
        let scripts = scene.objects().filter_map(|object| match &object.kind {
            Kind::Script(script) if self.scripts.languages.contains(&script.language) => {
                let path = scene.short_path(object.handle()).ok()?;
                let text = script.code.as_slice().into();
                Some(CountedText::Script {
                    scene: scene.settings().path.clone(),
                    path,
                    text,
                })
            }
            _ => None,
        });
        scripts.collect()
    }

    /// The name of a script's text in reports; None if its lines are not counted.
    pub(crate) fn counted_as(&self, script: &Script, text: &[u8]) -> Option<String> {
        let counts = self.options.count_lines && self.counts_text_of(script, text);
        counts.then(|| self.path_of_script(script).unwrap_or_default())
    }

    /// Whether the lines of a script's own text are counted: those of scripts in the scene, unless they are part of the simulator.
    fn counts_text_of(&self, script: &Script, text: &[u8]) -> bool {
        match script.script_type {
            ScriptType::Sandbox | ScriptType::AddOn => false,
            ScriptType::Main => text != self.modules.registry.main_script().as_bytes(),
            _ => true,
        }
    }

    /// The path of a script in reports; None if it is no longer in the scene.
    pub(crate) fn path_of_script(&self, script: &Script) -> Option<String> {
        let scene = self.scene.try_borrow().ok()?;
        match (script.object, script.owner()) {
            (Some(object), _) => scene.short_path(object).ok(),
            (None, Some(owner)) => Some(
                scene.short_path(owner).ok()?
                    + super::lifecycle::source::log_suffix(script.script_type),
            ),
            (None, None) => Some(format!("/{}", script.detached.borrow().name)),
        }
    }

    pub(crate) fn scene_path(&self) -> String {
        self.scene
            .try_borrow()
            .map(|scene| scene.settings().path.clone())
            .unwrap_or_default()
    }
}
