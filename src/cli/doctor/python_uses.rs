//! Which functions of the simulator a script in Python uses: Python itself reads the text.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use docs::{self, Use};
use script::{python_interpreter, python_parts};

/// Prints what a text on its input uses.
const READER: &str = include_str!("python_uses.py");

/// Everything of the simulator that a script uses; `file` is where it is from.
///
/// # Errors
/// When there is no Python to read it, or it is no Python; in words.
pub(super) fn uses(code: &[u8], file: &Path) -> Result<Vec<Use>, String> {
    let (lua, python) = python_parts(code);
    let mut all = docs::uses(&lua);
    let interpreter = python_interpreter(file.parent());
    let output = run(&interpreter, &python).map_err(|error| {
        format!("reading scripts in Python needs Python 3.9 or newer, and '{interpreter}' cannot be called: {error}")
    })?;
    for line in output.lines() {
        let mut fields = line.split('\t');
        let mut field = || fields.next().unwrap_or_default();
        let (kind, line, module, member, call) = (field(), field(), field(), field(), field());
        let line = line.parse().unwrap_or(1);
        match kind {
            "error" => return Err(format!("line {line}: {module}")),
            "module" => all.extend(docs::use_of_module(module, line)),
            _ => all.extend(docs::use_of_member(module, member, line, !call.is_empty())),
        }
    }
    Ok(all)
}

fn run(interpreter: &str, text: &[u8]) -> std::io::Result<String> {
    let mut command = Command::new(interpreter);
    command
        .args(["-c", READER])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let mut child = command.spawn()?;
    if let Some(mut input) = child.stdin.take() {
        input.write_all(text)?;
    }
    let output = child.wait_with_output()?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    Err(std::io::Error::other(
        String::from_utf8_lossy(&output.stderr)
            .trim_end()
            .to_owned(),
    ))
}
