//! Breakpoints: where code stops, on which condition, and after how many times.

use std::collections::{BTreeMap, BTreeSet};

use script::LoadedText;
use serde_json::{Value, json};

use crate::sources::{SourceKey, Sources};

/// A breakpoint of a line or function.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Breakpoint {
    /// Its number, for clients.
    pub id: u64,
    /// What decides, when its line is reached.
    pub rule: Rule,
    /// How often it was reached while its condition was true.
    pub hits: u64,
}

/// When a breakpoint stops code.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Rule {
    /// An expression that has to be true.
    pub condition: Option<String>,
    /// The number of times.
    pub count: Option<HitCount>,
    /// A text that is printed instead of stopping, with expressions in braces.
    pub log: Option<String>,
}

/// A condition on the number of times.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HitCount {
    /// The time with that number.
    Exactly(u64),
    /// From that time on, or after it.
    AtLeast(u64),
    /// Before that time.
    Below(u64),
    /// Every so many times.
    Every(u64),
}

impl HitCount {
    /// Reads `5`, `== 5`, `>= 5`, `> 5`, `< 5`, `<= 5` and `% 5`.
    fn parse(text: &str) -> Result<Self, String> {
        let digits = text.find(|c: char| c.is_ascii_digit());
        let (sign, number) = text.split_at(digits.unwrap_or(text.len()));
        let number = number.trim().parse::<u64>();
        let unknown = || format!("a hit count is a number, or such as >= 3 or % 2, not {text}");
        let number = number.map_err(|_| unknown())?;
        Ok(match sign.trim() {
            "" | "=" | "==" => Self::Exactly(number),
            ">=" => Self::AtLeast(number),
            ">" => Self::AtLeast(number.saturating_add(1)),
            "<" => Self::Below(number),
            "<=" => Self::Below(number.saturating_add(1)),
            "%" if number > 0 => Self::Every(number),
            _ => return Err(unknown()),
        })
    }

    /// Whether it holds at the time with that number, from 1.
    pub fn holds(self, hits: u64) -> bool {
        match self {
            Self::Exactly(number) => hits == number,
            Self::AtLeast(number) => hits >= number,
            Self::Below(number) => hits < number,
            Self::Every(number) => hits.is_multiple_of(number),
        }
    }
}

impl Rule {
    /// The rule in a breakpoint of the protocol.
    ///
    /// # Errors
    /// When the hit count is none.
    pub fn parse(requested: &Value) -> Result<Self, String> {
        let text = |name: &str| {
            let text = requested[name].as_str().map(str::trim);
            text.filter(|text| !text.is_empty()).map(str::to_owned)
        };
        let count = text("hitCondition");
        Ok(Self {
            condition: text("condition"),
            count: count.as_deref().map(HitCount::parse).transpose()?,
            log: text("logMessage"),
        })
    }
}

/// A breakpoint of a line.
struct OfLine {
    breakpoint: Breakpoint,
    /// The line that was asked for, and the one with code.
    requested: u32,
    line: Option<u32>,
}

/// A breakpoint of functions.
struct OfFunction {
    breakpoint: Breakpoint,
    name: String,
    /// Whether a text has such a function.
    is_known: bool,
}

/// All breakpoints.
#[derive(Default)]
pub struct Breakpoints {
    last_id: u64,
    of_lines: BTreeMap<SourceKey, Vec<OfLine>>,
    of_functions: Vec<OfFunction>,
}

impl Breakpoints {
    /// Replaces the breakpoints of a text; the answers for the client.
    pub fn set_lines(
        &mut self,
        key: SourceKey,
        requested: &[Value],
        sources: &Sources,
    ) -> Vec<Value> {
        let lines = sources.lines(&key);
        let (mut set, mut answers) = (Vec::new(), Vec::new());
        for requested in requested {
            let line = requested["line"]
                .as_u64()
                .and_then(|line| u32::try_from(line).ok());
            let rule = Rule::parse(requested);
            let (Some(line), Ok(rule)) = (line, rule.clone()) else {
                let reason = rule
                    .err()
                    .unwrap_or_else(|| "a breakpoint needs a line".into());
                answers.push(json!({"verified": false, "message": reason}));
                continue;
            };
            let new = OfLine {
                breakpoint: self.number(rule),
                requested: line,
                line: lines.as_ref().and_then(|lines| next(lines, line)),
            };
            answers.push(new.describe(lines.is_some()));
            set.push(new);
        }
        self.of_lines.insert(key, set);
        answers
    }

    /// Replaces the breakpoints of functions; the answers for the client.
    pub fn set_functions<'a>(
        &mut self,
        requested: &[Value],
        texts: impl Iterator<Item = &'a LoadedText> + Clone,
    ) -> Vec<Value> {
        self.of_functions.clear();
        let mut answers = Vec::new();
        for requested in requested {
            let rule = Rule::parse(requested);
            let name = requested["name"].as_str().unwrap_or_default().trim();
            let (false, Ok(rule)) = (name.is_empty(), rule.clone()) else {
                let reason = rule
                    .err()
                    .unwrap_or_else(|| "a function needs a name".into());
                answers.push(json!({"verified": false, "message": reason}));
                continue;
            };
            let new = OfFunction {
                breakpoint: self.number(rule),
                is_known: texts
                    .clone()
                    .any(|text| !lines_of_function(text, name).is_empty()),
                name: name.to_owned(),
            };
            answers.push(new.describe());
            self.of_functions.push(new);
        }
        answers
    }

    fn number(&mut self, rule: Rule) -> Breakpoint {
        self.last_id += 1;
        Breakpoint {
            id: self.last_id,
            rule,
            hits: 0,
        }
    }

    /// Places breakpoints in a text that was loaded; what changed, for the client.
    pub fn place(&mut self, text: &LoadedText) -> Vec<Value> {
        let mut changed = Vec::new();
        for key in SourceKey::all_of(text) {
            for of_line in self.of_lines.get_mut(&key).into_iter().flatten() {
                let line = next(&text.lines, of_line.requested);
                if of_line.line != line || line.is_none() {
                    of_line.line = line;
                    changed.push(of_line.describe(true));
                }
            }
        }
        for of_function in &mut self.of_functions {
            let is_here = !lines_of_function(text, &of_function.name).is_empty();
            if is_here && !std::mem::replace(&mut of_function.is_known, true) {
                changed.push(of_function.describe());
            }
        }
        changed
    }

    /// The lines of a text that have breakpoints.
    pub fn lines(&self, text: &LoadedText) -> BTreeSet<u32> {
        let functions = self.of_functions.iter();
        self.lines_of(text)
            .filter_map(|of_line| of_line.line)
            .chain(functions.flat_map(|function| lines_of_function(text, &function.name)))
            .collect()
    }

    fn lines_of(&self, text: &LoadedText) -> impl Iterator<Item = &OfLine> {
        SourceKey::all_of(text)
            .filter_map(|key| self.of_lines.get(&key))
            .flatten()
    }

    /// The numbers of the breakpoints of a line, and whether each is one of a function.
    pub fn at(&self, text: &LoadedText, line: u32) -> Vec<(u64, bool)> {
        let of_lines = self
            .lines_of(text)
            .filter(|of_line| of_line.line == Some(line))
            .map(|of_line| (of_line.breakpoint.id, false));
        let functions = self.of_functions.iter();
        let functions = functions
            .filter(|function| lines_of_function(text, &function.name).contains(&line))
            .map(|function| (function.breakpoint.id, true));
        of_lines.chain(functions).collect()
    }

    /// The breakpoint with that number.
    pub fn get_mut(&mut self, id: u64) -> Option<&mut Breakpoint> {
        let of_lines = self.of_lines.values_mut().flatten();
        let of_functions = self.of_functions.iter_mut();
        of_lines
            .map(|of_line| &mut of_line.breakpoint)
            .chain(of_functions.map(|function| &mut function.breakpoint))
            .find(|breakpoint| breakpoint.id == id)
    }

    /// Starts counting again.
    pub fn forget_hits(&mut self) {
        let of_lines = self.of_lines.values_mut().flatten();
        of_lines.for_each(|of_line| of_line.breakpoint.hits = 0);
        let functions = self.of_functions.iter_mut();
        functions.for_each(|function| function.breakpoint.hits = 0);
    }

    /// Removes all: the client that set them is gone.
    pub fn clear(&mut self) {
        self.of_lines.clear();
        self.of_functions.clear();
    }
}

impl OfLine {
    fn describe(&self, text_is_known: bool) -> Value {
        let id = self.breakpoint.id;
        match self.line {
            Some(line) => json!({"id": id, "verified": true, "line": line}),
            None if text_is_known => {
                json!({"id": id, "verified": false, "line": self.requested, "message": "there is no code from here on"})
            }
            None => {
                json!({"id": id, "verified": false, "line": self.requested, "message": "no script has loaded this text yet"})
            }
        }
    }
}

impl OfFunction {
    fn describe(&self) -> Value {
        let mut answer = json!({"id": self.breakpoint.id, "verified": self.is_known});
        if !self.is_known {
            answer["message"] = json!("no script has loaded a function of this name yet");
        }
        answer
    }
}

/// The line, or the next one with code.
fn next(lines: &BTreeSet<u32>, line: u32) -> Option<u32> {
    lines.range(line..).next().copied()
}

/// The first lines with code of the functions of that name: the whole one, or the part after the last dot.
fn lines_of_function(text: &LoadedText, name: &str) -> Vec<u32> {
    let is_named = |whole: &String| whole == name || whole.rsplit(['.', ':']).next() == Some(name);
    let functions = text.functions.iter();
    functions
        .filter(|function| function.name.as_ref().is_some_and(is_named))
        .filter_map(|function| function.lines.first().copied())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hit_counts() {
        let holds = |text: &str| {
            let count = HitCount::parse(text).expect("a hit count");
            (1..=6)
                .filter(|hits| count.holds(*hits))
                .collect::<Vec<_>>()
        };
        assert_eq!(holds("3"), [3]);
        assert_eq!(holds("== 3"), [3]);
        assert_eq!(holds(">=5"), [5, 6]);
        assert_eq!(holds("> 5"), [6]);
        assert_eq!(holds("<2"), [1]);
        assert_eq!(holds("<= 2"), [1, 2]);
        assert_eq!(holds("%2"), [2, 4, 6]);
        for wrong in ["", "x", "% 0", "!= 3", "3 4", "-1"] {
            assert!(HitCount::parse(wrong).is_err(), "{wrong}");
        }
    }
}
