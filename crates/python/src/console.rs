//! What scripts print and log, on the streams of Python.

use pyo3::prelude::*;
use script::log::verbosity;
use swanilda::{Console, LogLine};

/// Writes to `sys.stdout` and `sys.stderr`, whatever they are at the time.
pub struct PythonConsole;

impl Console for PythonConsole {
    fn print(&mut self, line: &[u8], _: f64) {
        write(
            "stdout",
            &(String::from_utf8_lossy(line).into_owned() + "\n"),
        );
    }

    fn log(&mut self, line: &LogLine<'_>) {
        if line.status {
            return;
        }
        let is_bad = verbosity::plain(line.level) <= verbosity::SCRIPT_WARNINGS;
        write(
            if is_bad { "stderr" } else { "stdout" },
            &(line.located() + "\n"),
        );
    }

    fn write(&mut self, text: &[u8], stream: script::OutputStream, _: f64) {
        let name = match stream {
            script::OutputStream::Output => "stdout",
            script::OutputStream::Error => "stderr",
        };
        write(name, &String::from_utf8_lossy(text));
    }
}

/// Nobody can be told of a stream that fails, nor when Python is about to end.
fn write(stream: &str, text: &str) {
    Python::try_attach(|py| {
        let stream = py.import("sys").and_then(|sys| sys.getattr(stream));
        let _ = stream.and_then(|stream| stream.call_method1("write", (text,)));
    });
}
