//! Time: starting and stopping, steps, and runs until something happens.

use mcp::Answer;
use scene::Data;
use serde_json::{Value, json};
use simulator::SimulationState;
use std::sync::atomic::Ordering;

use super::properties::{explained, unit_of};
use super::samples::Samples;
use super::{Group, count, flag, happened, list, moment, number, plot, text, tool};
use crate::agent::Agent;
use crate::arguments::Arguments;
use crate::values::{data, text_field};

pub(crate) const GROUP: Group = Group { tools, call };

/// Rows of a table, unless more are asked for.
const ROWS: u64 = 12;
/// Longest run without an own limit, seconds of simulated time.
const DEFAULT_TIME: f64 = 10.0;
/// Times are sums of steps: half a microsecond.
const ROUNDING: f64 = 5e-7;

/// How far to go, and what to look at meanwhile.
#[derive(Default)]
pub(super) struct Plan {
    pub steps: Option<u64>,
    /// From now on, seconds.
    pub time: Option<f64>,
    /// Conditions by their kinds, as `run_until` has them.
    pub until: Option<Value>,
    pub watch: Vec<String>,
    /// Between two samples, seconds; each step if that is 0.
    pub every: f64,
    /// Whether the client is told how far it is: not of parts of something.
    pub is_whole: bool,
}

/// What came of a plan.
pub(super) struct Outcome {
    pub steps: u64,
    pub samples: Samples,
    /// Why it ended.
    pub reason: String,
    /// Whether that is what was asked for.
    pub is_reached: bool,
}

/// The arguments about samples.
fn of_samples() -> Vec<(&'static str, Value)> {
    vec![
        (
            "watch",
            list(
                "Quantities to sample: properties (\"/Ball.position[3]\", \"/Arm/Joint.jointPosition\") or Lua expressions (\"sim.getObjectVelocity(sim.getObject('/Ball'))\")",
            ),
        ),
        (
            "every",
            number("Simulated seconds between samples [default: each step]"),
        ),
        (
            "rows",
            json!({"type": "integer", "minimum": 2, "maximum": 500, "description": "Rows of the table at most [default: 12]"}),
        ),
        ("plot", flag("Answer a plot of the samples too")),
    ]
}

fn tools() -> Vec<mcp::Tool> {
    let pair = json!({"type": "array", "items": {"type": ["string", "integer"]}, "minItems": 2, "maxItems": 2, "description": "Two objects"});
    let until = json!({
        "type": "object",
        "description": "What ends the run; the first that holds",
        "properties": {
            "collision": pair,
            "distance": {"type": "object", "description": "The distance of two objects", "properties": {"objects": pair, "below": number("metres"), "above": number("metres")}, "required": ["objects"]},
            "signal": {"type": "object", "description": "A signal is there, or has a value", "properties": {"name": text("its name"), "value": {"description": "its value"}}, "required": ["name"]},
            "joint": {"type": "object", "description": "A joint is at a position", "properties": {"joint": {"type": ["string", "integer"]}, "position": number("rad or m [default: its target]"), "tolerance": number("[default: 0.01]")}, "required": ["joint"]},
            "lua": text("A Lua expression that becomes true, such as \"sim.getObjectPosition(sim.getObject('/Ball'))[3] < 0.1\""),
        },
    });
    let with = |own: Vec<(&'static str, Value)>| -> Vec<(&'static str, Value)> {
        own.into_iter().chain(of_samples()).collect()
    };
    vec![
        tool(
            "simulation",
            "Start, pause, stop",
            "Starts, pauses or stops the simulation. Stopping brings the scene back to where it was before the start. `step` and `run_until` start it by themselves.",
            &[(
                "action",
                json!({"type": "string", "enum": ["start", "pause", "stop"], "description": "What to do"}),
            )],
            &["action"],
        ),
        tool(
            "step",
            "Step",
            "Runs a number of simulation steps, starting the simulation if it is stopped, and returns samples.",
            &with(vec![("count", count("Steps [default: 1]", 1_000_000))]),
            &[],
        ),
        tool(
            "run_until",
            "Run until",
            "Runs until a condition holds, a script raises an error, or `time` has passed, and returns samples: a table, the least and largest values, and a plot on request.",
            &with(vec![
                ("until", until),
                (
                    "time",
                    json!({"type": "number", "minimum": 0, "description": "Longest time to run, simulated seconds [default: 10]"}),
                ),
            ]),
            &[],
        ),
    ]
}

fn call(agent: &mut Agent, tool: &str, arguments: Arguments<'_>) -> Result<Answer, String> {
    let plan = match tool {
        "simulation" => return control(agent, arguments.text("action").unwrap_or_default()),
        "step" => Plan {
            steps: Some(arguments.count("count").unwrap_or(1)),
            ..Plan::of(arguments)
        },
        _ => Plan {
            time: Some(arguments.number("time").unwrap_or(DEFAULT_TIME)),
            until: arguments.get("until").cloned(),
            ..Plan::of(arguments)
        },
    };
    let outcome = advance(agent, &plan)?;
    Ok(report(agent, &outcome, arguments))
}

impl Plan {
    fn of(arguments: Arguments<'_>) -> Self {
        Self {
            watch: arguments.texts("watch"),
            every: arguments.number("every").unwrap_or_default(),
            is_whole: true,
            ..Self::default()
        }
    }
}

fn control(agent: &mut Agent, action: &str) -> Result<Answer, String> {
    match action {
        "start" => agent.sim.start(),
        "stop" => agent.sim.stop(),
        _ if agent.sim.state() == SimulationState::Stopped => {
            return Err("the simulation is stopped: there is nothing to pause; time stands still between calls anyway".into());
        }
        _ => {
            agent.sim.pause();
            finish_pause(agent);
        }
    }
    Ok(Answer::text(format!("Simulation {}.", moment(agent))).and_text(&happened(agent)))
}

/// A pause takes one more step.
fn finish_pause(agent: &mut Agent) {
    const MOST: usize = 3;
    for _ in 0..MOST {
        if !agent.sim.state().is_advancing() {
            return;
        }
        agent.sim.iterate();
    }
}

fn report(agent: &mut Agent, outcome: &Outcome, arguments: Arguments<'_>) -> Answer {
    let rows = arguments.count("rows").unwrap_or(ROWS) as usize;
    let mut out = format!(
        "{} after {} steps. Simulation {}.\n",
        outcome.reason,
        outcome.steps,
        moment(agent)
    );
    let mut values = json!({
        "steps": outcome.steps, "time": agent.sim.time(), "reached": outcome.is_reached, "reason": outcome.reason,
    });
    if !outcome.samples.is_empty() {
        out += &outcome.samples.text(rows);
        values["samples"] = outcome.samples.json(rows);
    }
    let answer = Answer::text(out).with(values).and_text(&happened(agent));
    if !arguments.flag("plot") {
        return answer;
    }
    match plot::png(&outcome.samples.curves()) {
        Some(file) => answer.and_png(file),
        None => answer.and_text("There is no plot: it needs numbers in `watch`."),
    }
}

/// Chooses what is sampled.
///
/// # Errors
/// When something cannot be read.
pub(super) fn watch(agent: &mut Agent, watched: &[String]) -> Result<(), String> {
    let texts = watched.iter().map(|text| Data::text(text)).collect();
    let failed = agent.helper("watch", &[Data::Array(texts)])?;
    let Some(error) = text_field(&failed, "error") else {
        return Ok(());
    };
    let number = failed.field("number").and_then(Data::as_f64).unwrap_or(1.0);
    let text = watched
        .get(number as usize - 1)
        .cloned()
        .unwrap_or_default();
    Err(format!(
        "`watch` {text}: {}",
        explained(agent, &text, &error)
    ))
}

/// Runs the simulation as planned.
///
/// # Errors
/// When a quantity or a condition cannot be read.
pub(super) fn advance(agent: &mut Agent, plan: &Plan) -> Result<Outcome, String> {
    let errors = agent.sim.errors();
    let has_stepped = start(agent, plan)?;
    let mut run = Advance::begin(agent, plan, errors);
    if has_stepped {
        (run.steps, run.begun) = (1, 0.0);
    }
    run.sample(agent)?;
    let (reason, is_reached) = run.go(agent)?;
    Ok(Outcome {
        steps: run.steps,
        samples: run.samples,
        reason,
        is_reached,
    })
}

/// Chooses what is looked for, and what is sampled.
fn prepare(agent: &mut Agent, plan: &Plan) -> Result<(), String> {
    let conditions = plan.until.as_ref().map_or(Data::Map(Vec::new()), data);
    if let Data::Text(error) = agent.helper("expect", &[conditions])? {
        let error = String::from_utf8_lossy(&error).into_owned();
        return Err(format!("`until` {}", explained(agent, "", &error)));
    }
    watch(agent, &plan.watch)
}

/// Starts or resumes the simulation. What is watched may be made in its first step; if it cannot be read then, nothing has
/// happened. Whether that step was made.
fn start(agent: &mut Agent, plan: &Plan) -> Result<bool, String> {
    if agent.sim.state() != SimulationState::Stopped {
        if agent.sim.state() == SimulationState::Paused {
            agent.sim.play();
        }
        return prepare(agent, plan).map(|()| false);
    }
    if prepare(agent, plan).is_ok() {
        agent.sim.start();
        return Ok(false);
    }
    let before = agent.sim.snapshot();
    agent.sim.step(1);
    let Err(error) = prepare(agent, plan) else {
        return Ok(true);
    };
    match before {
        Ok(before) => {
            agent
                .sim
                .restore(&before)
                .map_err(|error| error.to_string())?;
            agent.lines.take();
        }
        // Something is open that a snapshot does not reach.
        Err(_) => agent.sim.stop(),
    }
    Err(error)
}

/// A run that is under way.
struct Advance<'a> {
    plan: &'a Plan,
    begun: f64,
    errors: u64,
    steps: u64,
    next_sample: f64,
    samples: Samples,
}

impl<'a> Advance<'a> {
    fn begin(agent: &mut Agent, plan: &'a Plan, errors: u64) -> Self {
        let is_property = |name: &str| name.starts_with(['/', '#']) || name.starts_with("scene.");
        let mut named = |name: &String| {
            let unit = if is_property(name) {
                unit_of(agent, name)
            } else {
                ""
            };
            (name.clone(), unit)
        };
        let watched = plan.watch.iter().map(&mut named).collect();
        Self {
            samples: Samples::of(watched),
            plan,
            begun: agent.sim.time(),
            errors,
            steps: 0,
            next_sample: agent.sim.time(),
        }
    }

    /// Until something ends it: what, and whether that is what was asked for.
    fn go(&mut self, agent: &mut Agent) -> Result<(String, bool), String> {
        loop {
            if let Some(ended) = self.ended(agent) {
                return Ok(ended);
            }
            let (before, time) = (agent.sim.steps(), agent.sim.time());
            agent.sim.iterate();
            if agent.sim.time() < time {
                return Ok(("A script has stopped the simulation".into(), false));
            }
            self.steps += agent.sim.steps().saturating_sub(before);
            self.sample(agent)?;
            self.report(agent);
            if let Some(met) = met(agent)? {
                self.last_sample(agent)?;
                return Ok((format!("Reached: {met},"), true));
            }
        }
    }

    fn ended(&mut self, agent: &mut Agent) -> Option<(String, bool)> {
        let sim = &agent.sim;
        let passed = sim.time() - self.begun;
        let found = if sim.errors() > self.errors {
            if sim.state() == SimulationState::LastBeforePause {
                finish_pause(agent);
            }
            ("Ended by the error of a script", false)
        } else if agent.setting.options.stop.load(Ordering::Relaxed) {
            ("Ended early", false)
        } else if sim.state() == SimulationState::Stopped {
            ("A script has stopped the simulation", false)
        } else if sim.state() == SimulationState::Paused {
            (
                "The simulation was paused by a script, or by the error of one,",
                false,
            )
        } else if self.plan.steps.is_some_and(|steps| self.steps >= steps) {
            ("Done", true)
        } else if self.plan.time.is_some_and(|time| passed + ROUNDING >= time) {
            if self.plan.until.is_some() {
                ("No condition held in that time", false)
            } else {
                ("Done", true)
            }
        } else {
            return None;
        };
        Some((found.0.to_owned(), found.1))
    }

    /// Tells the client how far the run is: steps, or seconds.
    fn report(&self, agent: &Agent) {
        if !self.plan.is_whole {
            return;
        }
        let time = agent.sim.time();
        let (done, total) = match self.plan.steps {
            Some(steps) => (self.steps as f64, Some(steps as f64)),
            None => (time - self.begun, self.plan.time),
        };
        let message = || format!("{} steps, simulated time {time:.3} s", self.steps);
        agent.progress.report(done, total, message);
    }

    fn sample(&mut self, agent: &mut Agent) -> Result<(), String> {
        let time = agent.sim.time();
        if self.plan.watch.is_empty() || time + ROUNDING < self.next_sample {
            return Ok(());
        }
        self.next_sample += self.plan.every;
        if let Data::Array(values) = agent.helper("sample", &[])? {
            self.samples.add(time, &values);
        }
        Ok(())
    }

    /// Where the run ends there is a sample too.
    fn last_sample(&mut self, agent: &mut Agent) -> Result<(), String> {
        if self.samples.times.last() == Some(&agent.sim.time()) {
            return Ok(());
        }
        self.next_sample = agent.sim.time();
        self.sample(agent)
    }
}

/// The condition that holds.
fn met(agent: &mut Agent) -> Result<Option<String>, String> {
    let answer = agent.helper("check", &[])?;
    match text_field(&answer, "error") {
        Some(error) => Err(format!("`until` {error}")),
        None => Ok(text_field(&answer, "met")),
    }
}
