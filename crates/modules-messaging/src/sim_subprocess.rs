//! `simSubprocess`: programs that scripts start.
//!
//! A program started by `execAsync` belongs to the script that started it: it is killed when the script ends.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;
use std::time::Duration;

use api_macro::api;

use super::{ApiError, ApiFn, Cx, Module, Result, functions};
use io::{Process, ProcessError, Program};
use scene::Data;
use script::{Bytes, Nil, Outside, Results, Table};

/// The module `simSubprocess`.
pub static MODULE: Module = Module {
    about: "Starts programs, where that is allowed (`--allow-run`).",
    functions: &[("Programs", FUNCTIONS)],
    outside: Outside::AllBut(&[]),
    ..Module::new("simSubprocess")
};

const FUNCTIONS: &[ApiFn] = functions![exec, exec_async, is_running, wait, kill, getpid];

/// How long the outputs of a program that has ended may stay open: another program may hold them.
const OUTPUT_TIMEOUT: Duration = Duration::from_secs(1);

/// The programs a script has started.
#[derive(Default)]
struct Processes {
    started: u64,
    by_handle: BTreeMap<String, Process>,
}

impl Processes {
    fn add(&mut self, process: Process) -> String {
        self.started += 1;
        let handle = format!("{:x}:simSubprocess.child", self.started);
        self.by_handle.insert(handle.clone(), process);
        handle
    }

    fn get(&mut self, handle: &str) -> Result<&mut Process> {
        self.by_handle.get_mut(handle).ok_or_else(unknown)
    }

    /// Reaps ended processes.
    fn reap(&mut self) {
        self.by_handle
            .values_mut()
            .for_each(|process| drop(process.exit_code()));
    }
}

/// Those of the calling script.
fn processes(cx: &Cx) -> Rc<RefCell<Processes>> {
    cx.script_state()
}

/// Runs a program and waits until it exits. Ctrl-c ends it with an error.
///
/// A program that ends by a signal is an error: the process crashed. So is one that cannot be started: waitForStarted timed out.
///
/// @param programPath the program
/// @param arguments a list of strings
/// @param input its standard input
/// @param opts useSearchPath (true): looks a name up in PATH; workingDir: a folder; openNewConsole: for Windows
/// @return exitCode
/// @return output at most 256 MiB
/// @return errorOutput at most 256 MiB
#[api("simSubprocess.exec")]
fn exec(
    cx: &mut Cx,
    program_path: String,
    arguments: Table,
    #[default(Bytes(Vec::new()))] input: Bytes,
    #[default(Table(Data::Nil))] opts: Table,
) -> Result<(i64, Bytes, Bytes)> {
    let program = program(cx, program_path, &arguments, &opts)?;
    let mut run = program.run(input.0).map_err(failure)?;
    let exit_code = cx.wait_for(None, || run.exit_code())?;
    let exit_code = exit_code.ok_or(ApiError::Interrupted)?.map_err(failure)?;
    cx.wait_for(Some(OUTPUT_TIMEOUT), || {
        run.outputs_are_complete().then_some(())
    })?;
    let (out, err) = run.outputs().map_err(failure)?;
    Ok((exit_code.into(), Bytes(out), Bytes(err)))
}

/// Starts a program, which inherits the simulator's output. It is killed when the calling script ends.
///
/// @param programPath the program
/// @param arguments a list of strings
/// @param opts as in simSubprocess.exec
/// @return handle valid in the calling script
#[api("simSubprocess.execAsync")]
fn exec_async(
    cx: &mut Cx,
    program_path: String,
    arguments: Table,
    #[default(Table(Data::Nil))] opts: Table,
) -> Result<String> {
    let process = program(cx, program_path, &arguments, &opts)?
        .start()
        .map_err(failure)?;
    let processes = processes(cx);
    processes.borrow_mut().reap();
    let handle = processes.borrow_mut().add(process);
    Ok(handle)
}

/// Whether a program is still running.
///
/// @param handle the program
/// @return result
#[api("simSubprocess.isRunning")]
fn is_running(cx: &Cx, handle: String) -> Result<bool> {
    Ok(processes(cx)
        .borrow_mut()
        .get(&handle)?
        .exit_code()
        .is_none())
}

/// Waits until a program exits. A program that ends by a signal is an error.
///
/// @param handle the program
/// @param timeout seconds; negative without limit
/// @return exitCode nil if the program is still running
#[api("simSubprocess.wait")]
fn wait(cx: &Cx, handle: String, #[default(5.0)] timeout: f64) -> Result<Results> {
    let processes = processes(cx);
    let mut processes = processes.borrow_mut();
    let process = processes.get(&handle)?;
    let exit_code = cx
        .wait_for(limit(timeout), || process.exit_code())?
        .transpose()
        .map_err(failure)?;
    Ok(Results(vec![
        exit_code.map_or(Data::Nil, |code| Data::Int(code.into())),
    ]))
}

/// A time limit of a script in seconds; None for no limit (negative or too large).
fn limit(timeout: f64) -> Option<Duration> {
    if timeout.is_nan() {
        Some(Duration::ZERO)
    } else {
        Duration::try_from_secs_f64(timeout).ok()
    }
}

/// Kills a program; its handle becomes invalid.
///
/// @param handle the program
#[api("simSubprocess.kill")]
fn kill(cx: &mut Cx, handle: String) -> Result<Nil> {
    processes(cx)
        .borrow_mut()
        .by_handle
        .remove(&handle)
        .ok_or_else(unknown)?
        .kill();
    Ok(Nil)
}

/// The process id of a program.
///
/// @param handle the program
/// @return pid
#[api("simSubprocess.getpid")]
fn getpid(cx: &Cx, handle: String) -> Result<i64> {
    Ok(processes(cx).borrow_mut().get(&handle)?.id().into())
}

fn program(cx: &Cx, path: String, args: &Table, opts: &Table) -> Result<Program> {
    cx.permissions().check_run(&path)?;
    let option = |name, default| opts.0.field(name).map_or(default, Data::truthy);
    let working_dir = match opts.0.field("workingDir") {
        None | Some(Data::Nil) => None,
        Some(folder) => Some(text(folder)?),
    };
    Ok(Program {
        path,
        args: match &args.0 {
            Data::Array(args) => args.iter().map(text).collect::<Result<_>>()?,
            _ => {
                return Err(ApiError::Other(
                    "the arguments of a program are a list of strings.".into(),
                ));
            }
        },
        search_path: option("useSearchPath", true),
        working_dir,
        new_console: option("openNewConsole", false),
    })
}

fn text(data: &Data) -> Result<String> {
    match data {
        Data::Text(bytes) | Data::Buffer(bytes) => Ok(String::from_utf8_lossy(bytes).into_owned()),
        Data::Int(number) => Ok(number.to_string()),
        Data::Float(number) => Ok(number.to_string()),
        _ => Err(ApiError::Other("a string is needed.".into())),
    }
}

fn unknown() -> ApiError {
    ApiError::Other("invalid object handle".into())
}

fn failure(error: ProcessError) -> ApiError {
    ApiError::Other(error.to_string())
}

#[cfg(test)]
mod tests {
    use super::limit;

    #[test]
    fn limits_are_what_can_be_waited_for() {
        assert_eq!(limit(0.5), Some(std::time::Duration::from_millis(500)));
        assert!(limit(-1.0).is_none() && limit(f64::INFINITY).is_none());
        assert!(limit(f64::NAN).is_some());
    }
}
