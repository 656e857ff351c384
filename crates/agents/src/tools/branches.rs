//! Snapshots, and several futures of one moment.

use mcp::Answer;
use serde_json::{Map, Value, json};

use super::code::outcome;
use super::samples::Samples;
use super::time::{Plan, advance};
use super::{Group, happened, list, moment, number, text, tool};
use crate::agent::Agent;
use crate::arguments::Arguments;
use crate::values;

pub(crate) const GROUP: Group = Group { tools, call };

/// Snapshots that are kept.
const MAX_SNAPSHOTS: usize = 20;
/// Variants of one comparison.
const MAX_VARIANTS: usize = 50;

fn tools() -> Vec<mcp::Tool> {
    vec![
        tool(
            "snapshot",
            "Snapshot",
            "Keeps everything as it is now under a name: scene, scripts with their variables, physics, time. `restore` brings it back, as often as wanted.",
            &[("name", text("A name [default: \"default\"]"))],
            &[],
        ),
        tool(
            "restore",
            "Restore a snapshot",
            "Brings back what a snapshot has kept.",
            &[(
                "name",
                text("The name of the snapshot [default: \"default\"]"),
            )],
            &[],
        ),
        tool(
            "compare_variants",
            "Compare variants",
            "Tries several variants from the present moment: for each one its Lua code runs, then the simulation for `time`; afterwards all is as before. Answers a table with the last, least and largest value of each measured quantity.",
            &[
                (
                    "variants",
                    json!({"type": "object", "description": "Lua code by the name of the variant, such as {\"P=10\": \"sim.setFloatProperty(...)\"}"}),
                ),
                (
                    "time",
                    json!({"type": "number", "minimum": 0, "description": "Simulated seconds for each"}),
                ),
                (
                    "measure",
                    list("Quantities, as `watch` of run_until: properties or Lua expressions"),
                ),
                (
                    "every",
                    number("Simulated seconds between samples [default: each step]"),
                ),
            ],
            &["variants", "time", "measure"],
        ),
    ]
}

fn call(agent: &mut Agent, tool: &str, arguments: Arguments<'_>) -> Result<Answer, String> {
    let name = arguments.text("name").unwrap_or("default");
    match tool {
        "snapshot" => snapshot(agent, name),
        "restore" => restore(agent, name),
        _ => compare(agent, arguments),
    }
}

fn snapshot(agent: &mut Agent, name: &str) -> Result<Answer, String> {
    if agent.snapshots.len() >= MAX_SNAPSHOTS && !agent.snapshots.contains_key(name) {
        return Err(format!(
            "there are {MAX_SNAPSHOTS} snapshots: use one of the names {}",
            names(agent)
        ));
    }
    let snapshot = agent.sim.snapshot().map_err(|error| error.to_string())?;
    agent.snapshots.insert(name.to_owned(), snapshot);
    Ok(
        Answer::text(format!("Kept as {name}. Simulation {}.", moment(agent)))
            .and_text(&happened(agent)),
    )
}

fn restore(agent: &mut Agent, name: &str) -> Result<Answer, String> {
    let Some(snapshot) = agent.snapshots.get(name) else {
        let known = if agent.snapshots.is_empty() {
            "there is none yet: `snapshot` makes one".to_owned()
        } else {
            format!("there are {}", names(agent))
        };
        return Err(format!("there is no snapshot {name}; {known}"));
    };
    agent
        .sim
        .restore(snapshot)
        .map_err(|error| error.to_string())?;
    Ok(Answer::text(format!(
        "Restored {name}. Simulation {}.",
        moment(agent)
    )))
}

fn names(agent: &Agent) -> String {
    agent
        .snapshots
        .keys()
        .cloned()
        .collect::<Vec<_>>()
        .join(", ")
}

fn compare(agent: &mut Agent, arguments: Arguments<'_>) -> Result<Answer, String> {
    let variants = arguments.get("variants").and_then(Value::as_object);
    let variants =
        variants.filter(|variants| !variants.is_empty() && variants.len() <= MAX_VARIANTS);
    let variants = variants
        .ok_or_else(|| format!("`variants` has 1 to {MAX_VARIANTS} entries: Lua code by name"))?;
    let plan = Plan {
        time: arguments.number("time"),
        watch: arguments.texts("measure"),
        every: arguments.number("every").unwrap_or_default(),
        ..Plan::default()
    };
    if plan.watch.is_empty() {
        return Err("name a quantity in `measure`: \"/Ball.position[3]\" for example".into());
    }
    let before = agent.sim.snapshot().map_err(|error| error.to_string())?;
    let mut table = Comparison::default();
    for (name, code) in variants {
        let tried = attempt(agent, code.as_str().unwrap_or_default(), &plan);
        agent
            .sim
            .restore(&before)
            .map_err(|error| error.to_string())?;
        table.add(name, tried);
    }
    Ok(Answer::text(format!(
        "{}All is as before: simulation {}.",
        table.text(),
        moment(agent)
    ))
    .with(table.json()))
}

/// What came of one variant: why it ended early, if it did, and its samples.
fn attempt(
    agent: &mut Agent,
    code: &str,
    plan: &Plan,
) -> Result<(Option<String>, Samples), String> {
    outcome(agent, code)??;
    let outcome = advance(agent, plan)?;
    let output = happened(agent);
    let early = (!outcome.is_reached)
        .then(|| format!("{} after {} steps. {output}", outcome.reason, outcome.steps));
    Ok((early, outcome.samples))
}

/// The table of a comparison.
#[derive(Default)]
struct Comparison {
    lines: String,
    rows: Vec<Value>,
}

impl Comparison {
    fn add(&mut self, name: &str, tried: Result<(Option<String>, Samples), String>) {
        let (early, samples) = match tried {
            Ok(tried) => tried,
            Err(error) => (Some(error), Samples::default()),
        };
        let mut quantities = Map::new();
        let mut cells = Vec::new();
        for curve in samples.curves() {
            let [low, high, last] = curve.figures();
            let [shown_low, shown_high, shown_last] = [low, high, last].map(values::number);
            cells.push(format!(
                "{} {shown_last} ({shown_low} to {shown_high})",
                curve.name
            ));
            quantities.insert(
                curve.name.to_owned(),
                json!({"last": last, "least": low, "largest": high}),
            );
        }
        self.lines += &format!("{name}: {}\n", cells.join("; "));
        if let Some(early) = &early {
            self.lines += &format!("  {}\n", early.trim_end().replace('\n', "\n  "));
        }
        self.rows
            .push(json!({"variant": name, "problem": early, "quantities": quantities}));
    }

    fn text(&self) -> String {
        format!(
            "Last value of each quantity (least to largest):\n{}",
            self.lines
        )
    }

    fn json(&self) -> Value {
        json!({"variants": self.rows})
    }
}
