//! The native part of `swanilda.test`: control of the simulator by a test.

mod branch;
mod button_interfaces;
mod cases;
mod run;
mod windows;

use std::rc::Rc;

use api_macro::api;

use super::{ApiError, ApiFn, Cx, Module, Result, functions};
use branch::Branches;
use scene::{Data, Handle, Key};
use script::test_bench::{
    ConsoleLine, Golden, GoldenContent, Snapshot, TestBench, Tolerances, Trace,
};

pub(super) static MODULE: Module = Module {
    inner: &[
        FUNCTIONS,
        branch::FUNCTIONS,
        cases::FUNCTIONS,
        run::FUNCTIONS,
        windows::FUNCTIONS,
    ],
    ..Module::new("swanilda.test")
};

const FUNCTIONS: &[ApiFn] = functions![
    is_test, iterate, errors, hash, lines, kill, file, time_limit, golden, image
];

fn bench(cx: &Cx) -> Result<Rc<TestBench>> {
    let bench = cx.test_bench().cloned();
    bench.ok_or_else(|| {
        ApiError::Other("this works in tests only: run the file with 'swanilda test'.".into())
    })
}

/// Whether this is a test.
///
/// @return isTest
#[api("swanilda.test.isTest")]
fn is_test(cx: &Cx) -> Result<bool> {
    Ok(cx.test_bench().is_some())
}

/// One iteration of the loop: a step when a simulation runs.
#[api("swanilda.test.iterate")]
fn iterate(cx: &mut Cx) -> Result<()> {
    bench(cx)?;
    let branches = cx.module_state::<Branches>().depth.get();
    if cx.call_depth() > 1 + branches {
        return Err(ApiError::Other(
            "a step cannot be made from within a step.".into(),
        ));
    }
    cx.run_loop_iteration();
    // Long steps execute few Lua instructions, so the limits would not be checked.
    if cx.is_interrupted() {
        Err(ApiError::Other("interrupted.".into()))
    } else {
        Ok(())
    }
}

/// Number of uncaught script errors.
///
/// @return count
#[api("swanilda.test.errors")]
fn errors(cx: &Cx) -> Result<i64> {
    Ok(cx.errors() as i64)
}

/// The hash of the state that scripts can observe, as `swanilda run --hash` prints it.
///
/// @return hash 16 hexadecimal digits
#[api("swanilda.test.hash")]
fn hash(cx: &Cx) -> Result<String> {
    Ok(format!("{:016x}", cx.state_hash()))
}

/// Captured prints and log lines.
///
/// @param first lines to leave out
/// @param unfinished with those that have no end so far
/// @return lines each with text, level, time and, of the log, origin
#[api("swanilda.test.lines")]
fn lines(cx: &Cx, #[default(0)] first: i64, #[default(false)] unfinished: bool) -> Result<Data> {
    let bench = bench(cx)?;
    let mut lines = bench.lines_from(usize::try_from(first).unwrap_or_default());
    if unfinished {
        lines.extend(bench.unfinished(cx.clock().time()));
    }
    Ok(Data::Array(lines.into_iter().map(line_data).collect()))
}

fn line_data(line: ConsoleLine) -> Data {
    Data::map([
        ("text", Data::text(&line.text)),
        ("level", Data::text(line.level)),
        ("time", Data::Float(line.time)),
        (
            "origin",
            line.origin.map_or(Data::Nil, |origin| Data::text(&origin)),
        ),
    ])
}

/// Ends a script without its clean-up, as if it had crashed.
///
/// @param scriptHandle the script
#[api("swanilda.test.kill")]
fn kill(cx: &mut Cx, script_handle: i64) -> Result<()> {
    bench(cx)?;
    let script = cx
        .script_by_handle(script_handle)
        .ok_or(ApiError::NoSuchScript)?;
    cx.abort_script(&script);
    Ok(())
}

/// The test's file, as the user named it.
///
/// @return path
#[api("swanilda.test.file")]
fn file(cx: &Cx) -> Result<String> {
    Ok(bench(cx)?.file.clone())
}

/// Limit of the simulated time of a test, seconds.
///
/// @return seconds
#[api("swanilda.test.timeLimit")]
fn time_limit(cx: &Cx) -> Result<f64> {
    Ok(bench(cx)?.time_limit)
}

/// Leaves a trace to be compared with the recorded one when the test is over.
///
/// @param name the recording
/// @param columns names of the quantities
/// @param rows time and the quantities, for each sample
/// @param tolerances absolute, relative, time; columns: an absolute one for each named quantity
#[api("swanilda.test.golden")]
fn golden(cx: &mut Cx, name: String, columns: Data, rows: Data, tolerances: Data) -> Result<()> {
    let trace = Trace {
        columns: names_of(&columns)?,
        rows: rows_of(&rows)?,
    };
    let content = GoldenContent::Trace {
        trace,
        tolerances: tolerances_of(&tolerances),
    };
    let golden = Golden { name, content };
    bench(cx)?.add_golden(&golden);
    Ok(())
}

/// Leaves what a camera or a vision sensor sees, to be compared with the recorded picture when the test is over.
///
/// @param name the recording
/// @param sensor a vision sensor, whose last picture counts if there is one; or a camera
/// @param tolerance how far a colour may be off, of 255
/// @param share which share of the pixels may be off by more, 0 to 1
#[api("swanilda.test.image")]
fn image(cx: &mut Cx, name: String, sensor: Handle, tolerance: f64, share: f64) -> Result<()> {
    let (resolution, mut pixels) = cx.seen_image(sensor)?;
    let rows: Vec<Vec<u8>> = pixels
        .chunks_exact(3 * resolution[0] as usize)
        .map(<[u8]>::to_vec)
        .rev()
        .collect();
    pixels = rows.concat();
    let snapshot = Snapshot {
        resolution,
        pixels,
        tolerance: tolerance as u8,
        share,
    };
    bench(cx)?.add_golden(&Golden {
        name,
        content: GoldenContent::Image(snapshot),
    });
    Ok(())
}

fn names_of(columns: &Data) -> Result<Vec<String>> {
    let Data::Array(names) = columns else {
        return Err(not_a_trace());
    };
    let name = |name: &Data| {
        if let Data::Text(name) = name {
            Some(String::from_utf8_lossy(name).into_owned())
        } else {
            None
        }
    };
    names
        .iter()
        .map(name)
        .collect::<Option<_>>()
        .ok_or_else(not_a_trace)
}

fn rows_of(rows: &Data) -> Result<Vec<Vec<f64>>> {
    let Data::Array(rows) = rows else {
        return Err(not_a_trace());
    };
    rows.iter()
        .map(numbers)
        .collect::<Option<_>>()
        .ok_or_else(not_a_trace)
}

fn numbers(row: &Data) -> Option<Vec<f64>> {
    let Data::Array(values) = row else {
        return None;
    };
    values.iter().map(Data::as_f64).collect()
}

fn not_a_trace() -> ApiError {
    ApiError::Other("a trace is made of names and numbers.".into())
}

fn tolerances_of(data: &Data) -> Tolerances {
    let standard = Tolerances::default();
    let number = |name: &str| data.field(name).and_then(Data::as_f64);
    let columns = match data.field("columns") {
        Some(Data::Map(entries)) => entries.iter().filter_map(column_tolerance).collect(),
        _ => standard.columns,
    };
    Tolerances {
        absolute: number("absolute").unwrap_or(standard.absolute),
        relative: number("relative").unwrap_or(standard.relative),
        time: number("time").unwrap_or(standard.time),
        columns,
    }
}

fn column_tolerance((name, value): &(Key, Data)) -> Option<(String, f64)> {
    match name {
        Key::Text(name) => Some((String::from_utf8_lossy(name).into_owned(), value.as_f64()?)),
        _ => None,
    }
}
