//! The native part of `swanilda.test`: running a scene in a separate simulator.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use api_macro::api;

use super::{bench, line_data};
use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::object::script_object::ScriptType;
use scene::{Data, Key};
use script::Options;
use script::test_bench::{RunReport, RunRequest};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![run];

/// Runs a scene as `swanilda run` does, in a simulator of its own, to its end.
///
/// @param file the scene
/// @param options as, empty, start, loops, steps, time, seed, params
/// @return result output, lines, errors, steps, time, params
#[api("swanilda.test.run")]
fn run(cx: &mut Cx, file: String, options: Data) -> Result<Data> {
    let bench = bench(cx)?;
    let run_apart = bench
        .run_apart
        .ok_or_else(|| wrong("a scene that runs by itself cannot run others."))?;
    let named_options = NamedOptions::new(&options)?;
    let request = named_options.request(&file, bench.time_limit)?;
    let options = named_options.options(cx.options(), &request.scene)?;
    let report = run_apart(options, &request).map_err(ApiError::Other)?;
    if cx.is_interrupted() {
        return Err(wrong("interrupted."));
    }
    cx.add_line_counts(report.line_counts.clone());
    Ok(report_data(report))
}

/// The options of a run, by name.
struct NamedOptions<'a>(BTreeMap<&'a str, &'a Data>);

const NAMES: [&str; 8] = [
    "as", "empty", "start", "loops", "steps", "time", "seed", "params",
];

impl<'a> NamedOptions<'a> {
    fn new(options: &'a Data) -> Result<Self> {
        let entries: &[(Key, Data)] = match options {
            Data::Map(entries) => entries,
            Data::Nil => &[],
            Data::Array(items) if items.is_empty() => &[],
            _ => return Err(wrong("the options of a run are a table.")),
        };
        let named = entries.iter().map(|(key, value)| match key {
            Key::Text(name) => Ok((std::str::from_utf8(name).unwrap_or_default(), value)),
            _ => Err(wrong("the options of a run have names.")),
        });
        let named_options = Self(named.collect::<Result<_>>()?);
        match named_options.0.keys().find(|name| !NAMES.contains(name)) {
            Some(name) => Err(wrong(&format!(
                "a run has no option '{name}'; there are {}.",
                NAMES.join(", ")
            ))),
            None => Ok(named_options),
        }
    }

    fn number(&self, name: &str) -> Result<Option<f64>> {
        let Some(data) = self.0.get(name) else {
            return Ok(None);
        };
        let number = data.as_f64().filter(|number| *number >= 0.0);
        number
            .map(Some)
            .ok_or_else(|| wrong(&format!("'{name}' is a number, zero or more.")))
    }

    fn flag(&self, name: &str, standard: bool) -> bool {
        self.0.get(name).map_or(standard, |data| data.truthy())
    }

    fn kind(&self) -> Result<ScriptType> {
        match self.0.get("as") {
            None => Ok(ScriptType::Customization),
            Some(Data::Text(name)) => kind(name),
            Some(_) => Err(wrong("'as' is a text.")),
        }
    }

    fn request(&self, file: &str, time_limit: f64) -> Result<RunRequest> {
        Ok(RunRequest {
            scene: PathBuf::from(file),
            kind: self.kind()?,
            empty: self.flag("empty", false),
            start: self.flag("start", true),
            loops: self.number("loops")?.map_or(20, |number| number as u64),
            steps: self.number("steps")?.map(|number| number as u64),
            time: self.number("time")?,
            time_limit,
        })
    }

    /// Those of the test's simulator but for what belongs to the scene.
    fn options(&self, own: &Options, scene: &Path) -> Result<Options> {
        let seed = self.number("seed")?.map_or(own.seed, |seed| seed as u32);
        let folder = scene
            .parent()
            .filter(|folder| *folder != Path::new(""))
            .unwrap_or(Path::new("."));
        let package_dirs = vec![folder.to_owned()];
        Ok(Options {
            seed,
            package_dirs,
            named_params: self.params()?,
            ..own.clone()
        })
    }

    fn params(&self) -> Result<BTreeMap<String, String>> {
        let Some(params) = self.0.get("params") else {
            return Ok(BTreeMap::new());
        };
        let Data::Map(entries) = params else {
            return Err(wrong("'params' is a table of names and values."));
        };
        entries
            .iter()
            .map(|(key, value)| Ok((text_of_key(key)?, text_of(value)?)))
            .collect()
    }
}

fn kind(name: &[u8]) -> Result<ScriptType> {
    match name {
        b"customization" => Ok(ScriptType::Customization),
        b"simulation" => Ok(ScriptType::Simulation),
        b"addon" => Ok(ScriptType::AddOn),
        b"sandbox" => Ok(ScriptType::Sandbox),
        b"main" => Ok(ScriptType::Main),
        _ => Err(wrong(
            "'as' is customization, simulation, addon, sandbox or main.",
        )),
    }
}

fn text_of_key(key: &Key) -> Result<String> {
    match key {
        Key::Text(name) => Ok(String::from_utf8_lossy(name).into_owned()),
        _ => Err(wrong("'params' is a table of names and values.")),
    }
}

fn text_of(value: &Data) -> Result<String> {
    match value {
        Data::Text(text) => Ok(String::from_utf8_lossy(text).into_owned()),
        Data::Int(number) => Ok(number.to_string()),
        Data::Float(number) => Ok(number.to_string()),
        Data::Bool(truth) => Ok(truth.to_string()),
        _ => Err(wrong("a parameter is a text, a number or a truth value.")),
    }
}

fn report_data(report: RunReport) -> Data {
    let output: String = report
        .lines
        .iter()
        .map(|line| line.shown() + "\n")
        .collect();
    let params = report
        .params
        .into_iter()
        .map(|(name, value)| (Key::Text(name.into_bytes()), Data::text(&value)));
    let params = Data::Map(params.collect());
    let lines = Data::Array(
        report
            .lines
            .into_iter()
            .map(line_data)
            .collect::<Vec<Data>>(),
    );
    Data::map([
        ("output", Data::text(&output)),
        ("lines", lines),
        ("errors", Data::Int(report.errors as i64)),
        ("steps", Data::Int(report.steps as i64)),
        ("time", Data::Float(report.time)),
        ("params", params),
    ])
}

fn wrong(reason: &str) -> ApiError {
    ApiError::Other(reason.to_owned())
}
