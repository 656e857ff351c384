//! What scripts print and log, on the streams of Python.

use std::rc::Rc;

use pyo3::exceptions::PyException;
use pyo3::prelude::*;
use script::log::verbosity;
use swanilda::{Console, LogLine};

use crate::worlds::Shared;

/// Writes to `sys.stdout` and `sys.stderr`, whatever they are at the time.
pub struct PythonConsole(pub Rc<Shared>);

impl Console for PythonConsole {
    fn print(&mut self, line: &[u8], _: f64) {
        self.write_to(
            "stdout",
            &(String::from_utf8_lossy(line).into_owned() + "\n"),
        );
    }

    fn log(&mut self, line: &LogLine<'_>) {
        if line.status {
            return;
        }
        let is_bad = verbosity::plain(line.level) <= verbosity::SCRIPT_WARNINGS;
        self.write_to(
            if is_bad { "stderr" } else { "stdout" },
            &(line.located() + "\n"),
        );
    }

    fn write(&mut self, text: &[u8], stream: script::OutputStream, _: f64) {
        let name = match stream {
            script::OutputStream::Output => "stdout",
            script::OutputStream::Error => "stderr",
        };
        self.write_to(name, &String::from_utf8_lossy(text));
    }
}

impl PythonConsole {
    /// Nobody can be told of a stream that fails, nor when Python is about to end. Ctrl-c in a stream that is written in Python is raised
    /// where Python called the simulator.
    fn write_to(&self, stream: &str, text: &str) {
        Python::try_attach(|py| {
            let stream = py.import("sys").and_then(|sys| sys.getattr(stream));
            let written = stream.and_then(|stream| stream.call_method1("write", (text,)));
            let Err(error) = written else { return };
            if !error.is_instance_of::<PyException>(py) {
                self.0.exception.borrow_mut().get_or_insert(error);
            }
        });
    }
}
