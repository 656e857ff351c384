//! The log of a simulator: who says what, and who learns of it.

use super::{Script, Sim};
use crate::log::console::LogLine;
use crate::log::verbosity;

impl Sim {
    pub(crate) fn log_from(&self, script: &Script, level: i64, text: &str) {
        let origin = script.log_name(&self.scene.borrow());
        let line = LogLine {
            origin: &origin,
            level,
            text,
            located: None,
            time: self.clock.time(),
            status: false,
        };
        self.log_line(&line, Some(script.id));
    }

    /// Logs an error of a script, for people with its file and what else helps.
    pub(crate) fn log_error(&self, script: &Script, text: &str) {
        let origin = script.log_name(&self.scene.borrow());
        let is_library = |name: &str| self.modules.registry.files.contains_key(name);
        let located = self
            .log
            .files
            .borrow()
            .locate(text, &self.hint(script, text), is_library);
        let (level, time) = (verbosity::SCRIPT_ERRORS, self.clock.time());
        let line = LogLine {
            origin: &origin,
            level,
            text,
            located: Some(&located),
            time,
            status: false,
        };
        self.log_line(&line, Some(script.id));
    }

    /// Logs in the name of the simulator itself: the one it has in the logs that existing tools read.
    pub(crate) fn log(&self, level: i64, text: &str) {
        let time = self.clock.time();
        self.log_line(
            &LogLine {
                origin: "CoppeliaSim",
                level,
                text,
                located: None,
                time,
                status: false,
            },
            None,
        );
    }

    /// Logs in the name of a plugin.
    pub(crate) fn log_as(&self, origin: &str, level: i64, text: &str) {
        let time = self.clock.time();
        self.log_line(
            &LogLine {
                origin,
                level,
                text,
                located: None,
                time,
                status: false,
            },
            None,
        );
    }

    /// Logs what the simulation does, in the sandbox's name as the original does.
    pub(crate) fn log_status(&self, text: &str) {
        let (level, time) = (verbosity::SCRIPT_INFOS, self.clock.time());
        self.log_line(
            &LogLine {
                origin: "sandboxScript",
                level,
                text,
                located: None,
                time,
                status: true,
            },
            None,
        );
    }

    fn log_line(&self, line: &LogLine<'_>, script: Option<i64>) {
        let LogLine {
            origin,
            level,
            text,
            ..
        } = *line;
        if level & verbosity::ONCE != 0 && !self.log.is_first(origin, level, text) {
            return;
        }
        // Listeners to events get the lines of scripts even where the console shows fewer.
        if verbosity::plain(level) <= self.log.verbosity().max(verbosity::SCRIPT_INFOS) {
            self.events.push_log_event(origin, level, text);
        }
        self.log.show(line, script);
    }
}
