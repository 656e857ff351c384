//! The scene as a tree, what has changed in it, and search of objects.

use std::collections::BTreeMap;

use mcp::Answer;
use scene::Data;
use serde_json::{Value, json};

use super::{Group, flag, happened, moment, object, reading, text, tool};
use crate::agent::Agent;
use crate::arguments::Arguments;
use crate::values::{data, number, text_field};

pub(crate) const GROUP: Group = Group { tools, call };

/// Objects of an answer.
const MAX_SHOWN: usize = 150;

/// An object as it is shown.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Row {
    handle: i64,
    parent: i64,
    kind: String,
    pub path: String,
    text: String,
    /// Metres; empty for what is nowhere.
    position: Vec<f64>,
}

fn tools() -> Vec<mcp::Tool> {
    let root = object("Path or handle of an object: only it and what is below it");
    vec![
        reading(tool(
            "scene",
            "Scene",
            "Shows the scene as a tree: handle, alias, type, position in the world, size, mass, joint positions, scripts. With `changes`: only what is different since it was last shown.",
            &[
                ("root", root.clone()),
                (
                    "depth",
                    json!({"type": "integer", "minimum": 0, "maximum": 100, "description": "Levels below the root or the top [default: all]"}),
                ),
                (
                    "changes",
                    flag("Show only what has changed since the last call of `scene`"),
                ),
            ],
            &[],
        )),
        reading(tool(
            "find_objects",
            "Find objects",
            "Finds objects by their alias or path, and by type.",
            &[
                (
                    "pattern",
                    text(
                        "Part of a path, or a pattern with * for any characters; upper and lower case do not matter",
                    ),
                ),
                (
                    "type",
                    json!({"type": "string", "enum": ["shape", "joint", "dummy", "camera", "light", "graph", "script", "vision sensor", "proximity sensor", "force sensor", "octree", "point cloud"], "description": "Only objects of this type"}),
                ),
                ("root", root),
            ],
            &[],
        )),
    ]
}

fn call(agent: &mut Agent, tool: &str, arguments: Arguments<'_>) -> Result<Answer, String> {
    let rows = rows(agent, arguments.get("root"))?;
    let answer = match tool {
        "find_objects" => find(&rows, arguments),
        _ if arguments.flag("changes") => changes(agent, rows, arguments)?,
        _ => tree(agent, rows, arguments),
    };
    Ok(answer.and_text(&happened(agent)))
}

/// The objects below one, itself first, or all.
pub(crate) fn rows(agent: &mut Agent, root: Option<&Value>) -> Result<Vec<Row>, String> {
    let root = root.map_or(Data::Nil, data);
    let Data::Array(rows) = agent.helper("rows", &[root])? else {
        return Ok(Vec::new());
    };
    Ok(rows.iter().map(row).collect())
}

fn row(data: &Data) -> Row {
    let int = |name| match data.field(name) {
        Some(Data::Int(value)) => *value,
        _ => -1,
    };
    let words = |name| text_field(data, name).unwrap_or_default();
    let position = match data.field("position") {
        Some(Data::Array(all)) => all.iter().filter_map(Data::as_f64).collect(),
        _ => Vec::new(),
    };
    Row {
        handle: int("handle"),
        parent: int("parent"),
        kind: words("kind"),
        path: words("path"),
        text: words("text"),
        position,
    }
}

impl Row {
    /// The end of its path: the alias, with an index where siblings share it.
    fn name(&self) -> &str {
        self.path.rsplit('/').next().unwrap_or(&self.path)
    }

    fn line(&self, name: &str) -> String {
        let place = if self.position.is_empty() {
            String::new()
        } else {
            let numbers: Vec<String> = self.position.iter().map(|x| number(rounded(*x))).collect();
            format!(" at ({}) m", numbers.join(", "))
        };
        let text = if self.text.is_empty() {
            String::new()
        } else {
            format!(", {}", self.text)
        };
        format!("{name} #{}: {}{place}{text}\n", self.handle, self.kind)
    }

    fn json(&self) -> Value {
        json!({"path": self.path, "handle": self.handle, "type": self.kind, "position": self.position, "about": self.text})
    }
}

/// To a tenth of a millimetre.
fn rounded(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}

fn tree(agent: &mut Agent, rows: Vec<Row>, arguments: Arguments<'_>) -> Answer {
    let depth = arguments
        .count("depth")
        .map_or(usize::MAX, |depth| depth as usize);
    let lines = tree_lines(&rows, depth);
    let mut out = format!("Simulation {}. {} objects", moment(agent), rows.len());
    out += if lines.len() > MAX_SHOWN {
        ", of which the first are:\n"
    } else {
        ":\n"
    };
    out.extend(lines.iter().take(MAX_SHOWN).map(String::as_str));
    if lines.len() > MAX_SHOWN {
        out += "Use `root`, `depth`, or find_objects to see others.\n";
    }
    if arguments.get("root").is_none() {
        agent.seen = Some(rows);
    }
    Answer::text(out)
}

/// The lines of a tree, children below their parents.
pub(crate) fn tree_lines(rows: &[Row], depth: usize) -> Vec<String> {
    let mut below: BTreeMap<i64, Vec<&Row>> = BTreeMap::new();
    let known: std::collections::BTreeSet<i64> = rows.iter().map(|row| row.handle).collect();
    for row in rows {
        let parent = if known.contains(&row.parent) {
            row.parent
        } else {
            -1
        };
        below.entry(parent).or_default().push(row);
    }
    let mut lines = Vec::new();
    let roots = below.get(&-1).into_iter().flatten().rev();
    let mut pending: Vec<(usize, &Row)> = roots.map(|row| (0, *row)).collect();
    while let Some((level, row)) = pending.pop() {
        lines.push(format!("{}{}", "  ".repeat(level), row.line(row.name())));
        if level < depth {
            let children = below.get(&row.handle).into_iter().flatten().rev();
            pending.extend(children.map(|child| (level + 1, *child)));
        }
    }
    lines
}

fn changes(agent: &mut Agent, rows: Vec<Row>, arguments: Arguments<'_>) -> Result<Answer, String> {
    if arguments.get("root").is_some() {
        return Err("changes are those of the whole scene: leave `root` out".into());
    }
    let Some(seen) = agent.seen.replace(rows.clone()) else {
        return Err("the scene was not shown yet: call `scene` without `changes` first".into());
    };
    let lines = differences(&seen, &rows);
    let head = format!("Simulation {}. ", moment(agent));
    if lines.is_empty() {
        return Ok(Answer::text(format!("{head}Nothing has changed.")));
    }
    let rest = lines.len().saturating_sub(MAX_SHOWN);
    let more = if rest > 0 {
        format!("({rest} more)\n")
    } else {
        String::new()
    };
    let shown: String = lines.into_iter().take(MAX_SHOWN).collect();
    Ok(Answer::text(format!("{head}Changes:\n{shown}{more}")))
}

fn differences(before: &[Row], now: &[Row]) -> Vec<String> {
    let old: BTreeMap<i64, &Row> = before.iter().map(|row| (row.handle, row)).collect();
    let new: BTreeMap<i64, &Row> = now.iter().map(|row| (row.handle, row)).collect();
    let gone = before.iter().filter(|row| !new.contains_key(&row.handle));
    let mut lines: Vec<String> = gone
        .map(|row| format!("- {} #{} is gone\n", row.path, row.handle))
        .collect();
    for row in now {
        match old.get(&row.handle) {
            None => lines.push(format!("+ {}", row.line(&row.path))),
            Some(earlier) if is_changed(earlier, row) => {
                lines.push(format!("~ {}", row.line(&row.path)));
            }
            Some(_) => {}
        }
    }
    lines
}

fn is_changed(before: &Row, now: &Row) -> bool {
    let place = |row: &Row| row.position.iter().map(|x| rounded(*x)).collect::<Vec<_>>();
    before.path != now.path || before.text != now.text || place(before) != place(now)
}

fn find(rows: &[Row], arguments: Arguments<'_>) -> Answer {
    let pattern = arguments.text("pattern").unwrap_or_default().to_lowercase();
    let kind = arguments.text("type");
    let fits = |row: &&Row| {
        kind.is_none_or(|kind| row.kind == kind) && matches(&pattern, &row.path.to_lowercase())
    };
    let found: Vec<&Row> = rows.iter().filter(fits).collect();
    if found.is_empty() {
        return Answer::text(format!(
            "None of {} objects fits. A shorter pattern finds more; `scene` shows all.",
            rows.len()
        ));
    }
    let rest = found.len().saturating_sub(MAX_SHOWN);
    let mut out: String = found
        .iter()
        .take(MAX_SHOWN)
        .map(|row| row.line(&row.path))
        .collect();
    if rest > 0 {
        out += &format!("({rest} more: make the pattern longer)\n");
    }
    let all: Vec<Value> = found.iter().take(MAX_SHOWN).map(|row| row.json()).collect();
    Answer::text(out).with(json!({"objects": all}))
}

/// Whether a text contains the parts of a pattern between its stars, in order.
pub(super) fn matches(pattern: &str, text: &str) -> bool {
    if !pattern.contains('*') {
        return text.contains(pattern);
    }
    let mut rest = text;
    let mut parts = pattern.split('*').peekable();
    let first = parts.next().unwrap_or_default();
    // A pattern may begin in the middle of a path, at the begin of a name.
    match rest
        .rfind(&format!("/{first}"))
        .filter(|_| !first.starts_with('/'))
    {
        Some(at) if !first.is_empty() => rest = &rest[at + 1 + first.len()..],
        _ => match rest.strip_prefix(first) {
            Some(after) => rest = after,
            None => return false,
        },
    }
    while let Some(part) = parts.next() {
        if parts.peek().is_none() {
            return rest.ends_with(part);
        }
        match rest.find(part) {
            Some(at) => rest = &rest[at + part.len()..],
            None => return false,
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(handle: i64, parent: i64, alias: &str, x: f64) -> Row {
        Row {
            handle,
            parent,
            kind: "dummy".into(),
            path: format!("/{alias}"),
            text: String::new(),
            position: vec![x, 0.0, 0.0],
        }
    }

    #[test]
    fn children_stand_below_their_parents_whatever_the_order_is() {
        let rows = [
            row(1, -1, "a", 0.0),
            row(2, -1, "b", 0.0),
            row(3, 1, "c", 0.0),
            row(4, 3, "d", 0.0),
        ];
        let lines = tree_lines(&rows, 1);
        let names: Vec<&str> = lines
            .iter()
            .map(|line| line.split(" #").next().unwrap())
            .collect();
        assert_eq!(names, ["a", "  c", "b"]);
    }

    #[test]
    fn changes_are_what_is_new_gone_or_moved() {
        let before = [
            row(1, -1, "a", 0.0),
            row(2, -1, "b", 0.0),
            row(3, -1, "c", 0.0),
        ];
        let now = [
            row(1, -1, "a", 1e-9),
            row(3, -1, "c", 0.5),
            row(4, -1, "d", 0.0),
        ];
        let lines = differences(&before, &now);
        assert_eq!(
            lines,
            [
                "- /b #2 is gone\n",
                "~ /c #3: dummy at (0.5, 0, 0) m\n",
                "+ /d #4: dummy at (0, 0, 0) m\n"
            ]
        );
    }

    #[test]
    fn patterns() {
        for (pattern, text, fits) in [
            ("", "/a", true),
            ("ab", "/cabd", true),
            ("/robot*", "/robot/wheel", true),
            ("wheel*", "/robot/wheel_left", true),
            ("*left", "/robot/wheel_left", true),
            ("wheel*left", "/robot/wheel_left", true),
            ("wheel*right", "/robot/wheel_left", false),
            ("heel*", "/robot/wheel", false),
            ("/robot*x", "/robot", false),
        ] {
            assert_eq!(matches(pattern, text), fits, "{pattern} {text}");
        }
    }
}
