//! The part of YAML that files of parameters use: mappings and lists by indentation or in brackets, scalars, comments.
//!
//! A library would read much more than that (anchors, whose expansion has no bound, tags, several documents); here the rest is a warning.

use super::notes::Notes;
use super::tree::{Node, Tree};
use crate::limits;
use crate::xml::short;

/// Levels of indentation and brackets.
const MAX_DEPTH: usize = 32;

/// A line with something in it.
struct Line<'a> {
    number: u32,
    indent: usize,
    text: &'a str,
}

/// Reads a text; what is not understood is left out.
pub(super) fn parse(text: &str, notes: &mut Notes) -> Tree {
    if text.len() > limits::BYTES {
        notes.add(1, "YAML", "the file is too long");
        return Tree::new(1, Node::Nothing);
    }
    let lines: Vec<Line> = text.lines().enumerate().filter_map(line).collect();
    let mut reader = Reader {
        lines: &lines,
        at: 0,
        notes,
    };
    let node = reader.block(0, 0);
    if let Some(line) = reader.lines.get(reader.at) {
        let message = format!("'{}' is not understood here", short(line.text));
        reader.notes.add(line.number, "YAML", message);
    }
    Tree::new(1, node)
}

fn line((number, text): (usize, &str)) -> Option<Line<'_>> {
    let text = without_comment(text).trim_end();
    let content = text.trim_start();
    if content.is_empty() || content == "---" || content.starts_with('%') {
        return None;
    }
    Some(Line {
        number: u32::try_from(number + 1).unwrap_or(u32::MAX),
        indent: text.len() - content.len(),
        text: content,
    })
}

/// A comment begins with a `#` at the start or after a space, outside of quotes.
fn without_comment(text: &str) -> &str {
    let (mut quote, mut before) = (None, ' ');
    for (at, letter) in text.char_indices() {
        match (quote, letter) {
            (None, '#') if before.is_whitespace() => return &text[..at],
            (None, '\'' | '"') => quote = Some(letter),
            (Some(open), _) if open == letter => quote = None,
            _ => {}
        }
        before = letter;
    }
    text
}

struct Reader<'a> {
    lines: &'a [Line<'a>],
    at: usize,
    notes: &'a mut Notes,
}

impl<'a> Reader<'a> {
    fn peek(&self) -> Option<(u32, usize, &'a str)> {
        let line = self.lines.get(self.at)?;
        Some((line.number, line.indent, line.text))
    }

    /// What stands at an indentation of at least so many spaces.
    fn block(&mut self, least: usize, depth: usize) -> Node {
        let Some((number, indent, text)) = self.peek().filter(|(_, indent, _)| *indent >= least)
        else {
            return Node::Nothing;
        };
        if depth > MAX_DEPTH {
            self.notes.add(number, "YAML", "there are too many levels");
            self.skip(indent);
            return Node::Nothing;
        }
        if is_item(text) {
            self.list(indent, depth)
        } else {
            self.mapping(indent, depth)
        }
    }

    /// Leaves out what is indented so far or more.
    fn skip(&mut self, indent: usize) {
        while self.peek().is_some_and(|(_, at, _)| at >= indent) {
            self.at += 1;
        }
    }

    fn list(&mut self, indent: usize, depth: usize) -> Node {
        let mut items = Vec::new();
        while let Some((number, _, text)) = self
            .peek()
            .filter(|(_, at, text)| *at == indent && is_item(text))
        {
            self.at += 1;
            let rest = text[1..].trim_start();
            let node = if rest.is_empty() {
                self.block(indent + 1, depth + 1)
            } else {
                self.value(number, rest)
            };
            items.push(Tree::new(number, node));
        }
        Node::List(items)
    }

    fn mapping(&mut self, indent: usize, depth: usize) -> Node {
        let mut entries = Vec::new();
        while let Some((number, at, text)) = self.peek().filter(|(_, at, _)| *at >= indent) {
            self.at += 1;
            let Some((key, rest)) = key_and_rest(text).filter(|_| at == indent) else {
                self.notes.add(
                    number,
                    "YAML",
                    format!("'{}' is not understood here", short(text)),
                );
                continue;
            };
            let node = if rest.is_empty() {
                self.below(indent, depth)
            } else {
                self.value(number, rest)
            };
            entries.push((key, Tree::new(number, node)));
        }
        Node::Table(entries)
    }

    /// The value of a key that stands below it: a list may be indented as the key is.
    fn below(&mut self, indent: usize, depth: usize) -> Node {
        match self.peek() {
            Some((_, at, text)) if at == indent && is_item(text) => self.block(indent, depth + 1),
            _ => self.block(indent + 1, depth + 1),
        }
    }

    /// A value in a line; brackets may close in a later one.
    fn value(&mut self, number: u32, text: &str) -> Node {
        let mut whole = text.to_owned();
        while whole.starts_with(['[', '{']) && !is_closed(&whole) {
            let Some((_, _, more)) = self.peek() else {
                break;
            };
            self.at += 1;
            whole.push(' ');
            whole.push_str(more);
        }
        let mut flow = Flow {
            text: &whole,
            at: 0,
        };
        match flow.value(number, 0) {
            Some(node) if flow.rest().is_empty() => node,
            _ => {
                self.notes.add(
                    number,
                    "YAML",
                    format!("'{}' is not understood", short(&whole)),
                );
                Node::Nothing
            }
        }
    }
}

fn is_item(text: &str) -> bool {
    text == "-" || text.starts_with("- ")
}

fn key_and_rest(text: &str) -> Option<(String, &str)> {
    let (key, rest) = match text.strip_prefix(['"', '\'']) {
        Some(inside) => {
            let (key, rest) = inside.split_once(&text[..1])?;
            (key, rest.strip_prefix(':')?)
        }
        None => text
            .split_once(": ")
            .or_else(|| Some((text.strip_suffix(':')?, "")))?,
    };
    let is_plain = !key.is_empty() && !key.contains(['[', '{', '&', '*']) || key.starts_with("/**");
    is_plain.then(|| (key.trim().to_owned(), rest.trim()))
}

fn is_closed(text: &str) -> bool {
    let opened = text.matches(['[', '{']).count();
    opened <= text.matches([']', '}']).count()
}

/// A value in brackets, or a scalar.
struct Flow<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Flow<'a> {
    fn rest(&self) -> &'a str {
        self.text[self.at..].trim_start()
    }

    fn value(&mut self, line: u32, depth: usize) -> Option<Node> {
        let rest = self.rest();
        self.at = self.text.len() - rest.len();
        match rest.chars().next()? {
            '[' | '{' if depth > MAX_DEPTH => None,
            '[' => self.list(line, depth),
            '{' => self.mapping(line, depth),
            quote @ ('"' | '\'') => {
                let end = rest[1..].find(quote)? + 1;
                self.at += end + 1;
                Some(Node::Text(rest[1..end].to_owned()))
            }
            '&' | '*' | '!' | '|' | '>' | '%' | '@' | '`' => None,
            _ => Some(self.scalar(depth > 0)),
        }
    }

    fn list(&mut self, line: u32, depth: usize) -> Option<Node> {
        let mut items = Vec::new();
        self.at += 1;
        while !self.eat("]") {
            items.push(Tree::new(line, self.value(line, depth + 1)?));
            if !self.eat(",") && !self.rest().starts_with(']') {
                return None;
            }
        }
        Some(Node::List(items))
    }

    fn mapping(&mut self, line: u32, depth: usize) -> Option<Node> {
        let mut entries = Vec::new();
        self.at += 1;
        while !self.eat("}") {
            let (key, _) = self.rest().split_once(':')?;
            self.at = self.text.len() - self.rest().len() + key.len() + 1;
            let key = key.trim().trim_matches(['"', '\'']).to_owned();
            entries.push((key, Tree::new(line, self.value(line, depth + 1)?)));
            if !self.eat(",") && !self.rest().starts_with('}') {
                return None;
            }
        }
        Some(Node::Table(entries))
    }

    fn eat(&mut self, mark: &str) -> bool {
        let rest = self.rest();
        let is_there = rest.starts_with(mark);
        if is_there {
            self.at = self.text.len() - rest.len() + mark.len();
        }
        is_there
    }

    fn scalar(&mut self, is_inside: bool) -> Node {
        let rest = self.rest();
        let end = if is_inside {
            rest.find([',', ']', '}']).unwrap_or(rest.len())
        } else {
            rest.len()
        };
        self.at += end;
        of_word(rest[..end].trim())
    }
}

fn of_word(word: &str) -> Node {
    match word {
        "" | "~" | "null" => Node::Nothing,
        "true" | "True" | "yes" | "on" => Node::Flag(true),
        "false" | "False" | "no" | "off" => Node::Flag(false),
        _ => match word.parse::<f64>() {
            Ok(number) if number.is_finite() => Node::Number(number),
            _ => Node::Text(word.to_owned()),
        },
    }
}
