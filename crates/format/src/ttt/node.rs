//! Chunks as a tree of names and values, for people and for text files: what `unpack` writes and `pack` reads.
//!
//! The names are those of the fields. A tree says all that a file says; bytes and texts of scripts are leaves that a caller may put
//! elsewhere.

use serde_json::Value as Json;

/// A value of a chunk, a list, or a stream of chunks.
#[derive(Debug, Clone, PartialEq)]
pub enum Node {
    Int(i64),
    Real(f64),
    /// A number of single precision: it is written with as many digits as it has.
    Single(f32),
    Text(String),
    Bytes(Vec<u8>),
    /// The text of a script.
    Script(Vec<u8>),
    List(Vec<Node>),
    Table(Vec<(String, Node)>),
}

/// Result with a description of the fault in a tree, with the names that lead there.
pub type NodeResult<T> = Result<T, String>;

/// How deep trees are read: as deep as compound shapes may be, which take a few levels each.
const MAX_DEPTH: usize = 400;

impl Node {
    pub fn table(entries: impl IntoIterator<Item = (&'static str, Self)>) -> Self {
        Self::Table(
            entries
                .into_iter()
                .map(|(name, node)| (name.to_owned(), node))
                .collect(),
        )
    }

    /// The entry of a table.
    pub fn get(&self, name: &str) -> Option<&Self> {
        let Self::Table(entries) = self else {
            return None;
        };
        entries
            .iter()
            .find(|(key, _)| key == name)
            .map(|(_, node)| node)
    }

    /// The entry of a table, to be changed.
    pub fn get_mut(&mut self, name: &str) -> Option<&mut Self> {
        let Self::Table(entries) = self else {
            return None;
        };
        entries
            .iter_mut()
            .find(|(key, _)| key == name)
            .map(|(_, node)| node)
    }

    /// The entry of a table.
    ///
    /// # Errors
    /// When it is not there.
    pub fn need(&self, name: &str) -> NodeResult<&Self> {
        self.get(name).ok_or_else(|| format!("`{name}` is missing"))
    }

    /// # Errors
    /// When it is no list.
    pub fn list(&self) -> NodeResult<&[Self]> {
        if let Self::List(items) = self {
            Ok(items)
        } else {
            Err("a list is needed".into())
        }
    }

    /// As many items as a thing has.
    ///
    /// # Errors
    /// When there are more or fewer.
    pub fn items<const N: usize>(&self) -> NodeResult<&[Self; N]> {
        let items = self.list()?;
        items
            .try_into()
            .map_err(|_| format!("{N} items are needed, {} are there", items.len()))
    }

    pub fn int(&self) -> NodeResult<i64> {
        if let Self::Int(int) = self {
            Ok(*int)
        } else {
            Err("a whole number is needed".into())
        }
    }

    /// A number, or the word for one that is none.
    pub fn real(&self) -> NodeResult<f64> {
        match self {
            Self::Int(int) => Ok(numbers::real_of(*int)),
            Self::Real(real) => Ok(*real),
            Self::Single(single) => Ok((*single).into()),
            Self::Text(word) if matches!(word.as_str(), "NaN" | "inf" | "-inf") => {
                word.parse().map_err(|_| "a number is needed".to_owned())
            }
            _ => Err("a number is needed".into()),
        }
    }

    pub fn bytes(&self) -> NodeResult<Vec<u8>> {
        match self {
            Self::Bytes(bytes) | Self::Script(bytes) => Ok(bytes.clone()),
            Self::Text(text) => Ok(text.clone().into_bytes()),
            _ => Err("a text or bytes are needed".into()),
        }
    }

    /// As JSON: short values on one line.
    pub fn print(&self) -> String {
        let mut out = String::new();
        self.print_at(&mut out, 0);
        out
    }

    fn print_at(&self, out: &mut String, indent: usize) {
        match self {
            Self::Int(int) => out.push_str(&int.to_string()),
            Self::Real(real) => out.push_str(&number(*real, &format!("{real:?}"))),
            Self::Single(single) => out.push_str(&number((*single).into(), &format!("{single:?}"))),
            Self::Text(text) => out.push_str(&Json::from(text.as_str()).to_string()),
            Self::Bytes(bytes) | Self::Script(bytes) => {
                use base64::Engine;
                let text = base64::engine::general_purpose::STANDARD.encode(bytes);
                out.push_str(&format!("{{\"base64\": \"{text}\"}}"));
            }
            Self::List(items) => {
                let items = items.iter().map(|item| (None, item));
                print_items(out, indent, ['[', ']'], items.collect());
            }
            Self::Table(entries) => {
                let entries = entries
                    .iter()
                    .map(|(name, node)| (Some(name.as_str()), node));
                print_items(out, indent, ['{', '}'], entries.collect());
            }
        }
    }

    fn is_leaf(&self) -> bool {
        match self {
            Self::List(items) => items
                .iter()
                .all(|item| matches!(item, Self::Int(_) | Self::Real(_) | Self::Single(_))),
            Self::Table(entries) => entries.is_empty(),
            _ => true,
        }
    }

    /// Out of JSON.
    ///
    /// # Errors
    /// When the text is no JSON, or holds what no file can hold.
    pub fn parse(text: &str) -> NodeResult<Self> {
        let json: Json = serde_json::from_str(text).map_err(|error| error.to_string())?;
        Self::of_json(json, 0)
    }

    fn of_json(json: Json, depth: usize) -> NodeResult<Self> {
        if depth > MAX_DEPTH {
            return Err("it is nested too deeply".into());
        }
        Ok(match json {
            Json::Number(number) => match number.as_i64() {
                Some(int) => Self::Int(int),
                None => Self::Real(number.as_f64().ok_or("a number is out of range")?),
            },
            Json::String(text) => Self::Text(text),
            Json::Array(items) => Self::List(
                items
                    .into_iter()
                    .map(|item| Self::of_json(item, depth + 1))
                    .collect::<NodeResult<_>>()?,
            ),
            Json::Object(entries) => match entries.get("base64") {
                Some(Json::String(text)) => {
                    use base64::Engine;
                    let bytes = base64::engine::general_purpose::STANDARD.decode(text);
                    Self::Bytes(bytes.map_err(|error| error.to_string())?)
                }
                _ => {
                    let entries = entries
                        .into_iter()
                        .map(|(name, item)| Ok((name, Self::of_json(item, depth + 1)?)));
                    Self::Table(entries.collect::<NodeResult<_>>()?)
                }
            },
            Json::Null | Json::Bool(_) => {
                return Err("null, true and false mean nothing here".into());
            }
        })
    }
}

fn number(value: f64, digits: &str) -> String {
    if value.is_finite() {
        digits.to_owned()
    } else {
        format!("\"{value}\"")
    }
}

fn print_items(
    out: &mut String,
    indent: usize,
    [open, close]: [char; 2],
    items: Vec<(Option<&str>, &Node)>,
) {
    let in_line = items
        .iter()
        .all(|(name, node)| name.is_none() && node.is_leaf() && !matches!(node, Node::List(_)));
    let (before, after) = if in_line {
        (" ".to_owned(), String::new())
    } else {
        (
            format!("\n{}", "  ".repeat(indent + 1)),
            format!("\n{}", "  ".repeat(indent)),
        )
    };
    out.push(open);
    for (at, (name, node)) in items.iter().enumerate() {
        if at > 0 {
            out.push(',');
        }
        if at > 0 || !in_line {
            out.push_str(&before);
        }
        if let Some(name) = name {
            out.push_str(&format!("{}: ", Json::from(*name)));
        }
        node.print_at(out, indent + 1);
    }
    if !items.is_empty() {
        out.push_str(&after);
    }
    out.push(close);
}

/// Puts the name of a place before what is wrong there.
pub fn at<T>(name: &str, result: NodeResult<T>) -> NodeResult<T> {
    result.map_err(|what| {
        if what.contains(": ") {
            format!("{name}/{what}")
        } else {
            format!("{name}: {what}")
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trees_come_back_from_json() {
        let tree = Node::table([
            (
                "pose",
                Node::List(vec![
                    Node::Real(0.1),
                    Node::Real(-0.0),
                    Node::Real(1e300),
                    Node::Int(3),
                ]),
            ),
            ("names", Node::List(vec![Node::Text("a \"b\"\n".into())])),
            ("blob", Node::Bytes(vec![0, 255])),
            ("inner", Node::Table(vec![])),
        ]);
        let text = tree.print();
        let mut back = Node::parse(&text).unwrap();
        if let Node::Table(entries) = &mut back {
            entries.sort_by_key(|(name, _)| {
                ["pose", "names", "blob", "inner"]
                    .iter()
                    .position(|n| n == name)
            });
        }
        assert_eq!(back, tree);
        assert_eq!(Node::Single(0.69).print(), "0.69");
        assert_eq!(
            Node::parse(&Node::Real(f64::NEG_INFINITY).print())
                .unwrap()
                .real(),
            Ok(f64::NEG_INFINITY)
        );
    }

    #[test]
    fn what_is_no_tree_is_an_error() {
        for text in ["", "null", "[1", "{\"base64\": \"?\"}", "1e999"] {
            assert!(Node::parse(text).is_err(), "{text}");
        }
        assert!(Node::parse(&"[".repeat(100_000)).is_err());
    }
}
