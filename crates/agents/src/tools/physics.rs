//! Contacts and joints, now.

use std::collections::BTreeMap;

use mcp::Answer;
use scene::{Data, Handle};
use serde_json::{Value, json};

use super::code::reference;
use super::{Group, happened, moment, object, reading, tool};
use crate::agent::Agent;
use crate::arguments::Arguments;
use crate::values::{data, number, text_field};

pub(crate) const GROUP: Group = Group { tools, call };

/// Pairs and joints of an answer.
const MAX_SHOWN: usize = 60;

fn tools() -> Vec<mcp::Tool> {
    vec![
        reading(tool(
            "contacts",
            "Contacts",
            "Lists which shapes touch each other now, and with which forces (those of the last sub-step of the physics).",
            &[(
                "object",
                object("Only contacts of this object and of what is below it"),
            )],
            &[],
        )),
        reading(tool(
            "joints",
            "Joints",
            "Lists joints with position, velocity, target, force or torque, its limit, and their interval.",
            &[("root", object("Only joints below this object"))],
            &[],
        )),
    ]
}

fn call(agent: &mut Agent, tool: &str, arguments: Arguments<'_>) -> Result<Answer, String> {
    let answer = if tool == "contacts" {
        contacts(agent, arguments.get("object"))?
    } else {
        joints(agent, arguments.get("root"))?
    };
    Ok(answer.and_text(&happened(agent)))
}

/// Contacts of one pair of shapes.
struct Touch {
    points: usize,
    /// On the first shape, newtons.
    force: [f64; 3],
    point: [f64; 3],
}

fn contacts(agent: &mut Agent, of: Option<&Value>) -> Result<Answer, String> {
    let wanted = match of {
        None => None,
        Some(object) => agent
            .helper("find", &[data(object)])
            .map(|handle| handle.as_f64())?,
    };
    let wanted = wanted.and_then(|handle| Handle::from_raw(handle as i64));
    let pairs = pairs(agent, wanted);
    if pairs.is_empty() {
        let hint = if agent.sim.steps() == 0 {
            " The physics has not run yet: `step` once."
        } else {
            ""
        };
        return Ok(Answer::text(format!(
            "Nothing touches. Simulation {}.{hint}",
            moment(agent)
        )));
    }
    let named = |agent: &Agent, shapes: [Handle; 2]| {
        let scene = agent.sim.scene();
        shapes.map(|handle| scene.short_path(handle).unwrap_or_default())
    };
    let (mut out, mut all) = (format!("Simulation {}.\n", moment(agent)), Vec::new());
    for (shapes, touch) in pairs.iter().take(MAX_SHOWN) {
        let names = named(agent, *shapes);
        out += &touch.line(&names);
        all.push(json!({"objects": names, "force": touch.force, "points": touch.points, "around": touch.point}));
    }
    Ok(Answer::text(out).with(json!({"contacts": all})))
}

impl Touch {
    fn line(&self, [first, second]: &[String; 2]) -> String {
        let size = self.force.iter().map(|x| x * x).sum::<f64>().sqrt();
        format!(
            "{first} and {second}: {} N ({}) on the first, {} points, around ({}) m\n",
            number(size),
            self.force.map(number).join(", "),
            self.points,
            self.point.map(number).join(", ")
        )
    }

    fn add(&mut self, force: [f64; 3], point: [f64; 3]) {
        self.points += 1;
        for axis in 0..3 {
            self.force[axis] += force[axis];
            self.point[axis] += (point[axis] - self.point[axis]) / self.points as f64;
        }
    }
}

fn pairs(agent: &Agent, of: Option<Handle>) -> BTreeMap<[Handle; 2], Touch> {
    let scene = agent.sim.scene();
    let is_meant = |shapes: &[Handle; 2]| {
        of.is_none_or(|of| {
            shapes
                .iter()
                .any(|shape| scene.is_ancestor_or_self(of, *shape))
        })
    };
    let mut pairs: BTreeMap<[Handle; 2], Touch> = BTreeMap::new();
    for contact in agent
        .sim
        .last_contacts()
        .iter()
        .filter(|contact| is_meant(&contact.shapes))
    {
        let first = contact.shapes[0].min(contact.shapes[1]);
        let contact = contact.seen_from(first);
        let touch = pairs.entry(contact.shapes).or_insert(Touch {
            points: 0,
            force: [0.0; 3],
            point: [0.0; 3],
        });
        touch.add(contact.force, contact.point);
    }
    pairs
}

fn joints(agent: &mut Agent, root: Option<&Value>) -> Result<Answer, String> {
    let Data::Array(rows) = agent.helper("joints", &[reference(root)])? else {
        return Ok(Answer::text("There are no joints."));
    };
    if rows.is_empty() {
        return Ok(Answer::text("There are no joints here that turn or slide."));
    }
    let mut out = format!("Simulation {}.\n", moment(agent));
    out.extend(rows.iter().take(MAX_SHOWN).map(joint_line));
    if rows.len() > MAX_SHOWN {
        out += &format!("({} more: use `root`)\n", rows.len() - MAX_SHOWN);
    }
    let all: Vec<Value> = rows.iter().map(crate::values::value).collect();
    Ok(Answer::text(out).with(json!({"joints": all})))
}

fn joint_line(row: &Data) -> String {
    let words = |name| text_field(row, name).unwrap_or_default();
    let value = |name| row.field(name).and_then(Data::as_f64);
    let shown = |name| number(value(name).unwrap_or_default());
    let unit = words("unit");
    let effort = if unit == "m" { "N" } else { "Nm" };
    let mode = words("mode");
    let speed = if mode.starts_with("velocity") {
        "/s"
    } else {
        ""
    };
    let target = value("target").map(|target| format!(", target {} {unit}{speed}", number(target)));
    let interval = match (value("low"), value("high")) {
        (Some(low), Some(high)) => format!(", between {} and {} {unit}", number(low), number(high)),
        _ => String::new(),
    };
    let idle = if row.field("idle").is_some() {
        ", not moved by the physics: that takes a shape above the joint and a dynamic shape below it"
    } else {
        ""
    };
    let limit = value("limit").map(|limit| format!(" of at most {} {effort}", number(limit)));
    format!(
        "{}: {} {unit}, {} {unit}/s, {mode}{}, {} {effort}{}{interval}{idle}\n",
        words("path"),
        shown("position"),
        shown("velocity"),
        target.unwrap_or_default(),
        shown("force"),
        limit.unwrap_or_default()
    )
}
