//! The counts of the lines that scripts have run.

use super::{Interpreter, Script, Sim, log_suffix};
use crate::coverage::{CountedText, LineCounts};
use scene::Kind;
use scene::object::script_object::ScriptType;

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
                let text = script.code.as_slice().to_vec();
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
            (None, Some(owner)) => {
                Some(scene.short_path(owner).ok()? + log_suffix(script.script_type))
            }
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
