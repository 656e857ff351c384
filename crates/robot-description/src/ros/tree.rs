//! Values of YAML and TOML, with their lines.

/// A value and its line, from 1.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tree {
    pub line: u32,
    pub node: Node,
}

/// What a value is.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Node {
    Nothing,
    Number(f64),
    Text(String),
    Flag(bool),
    List(Vec<Tree>),
    /// In the order of the file.
    Table(Vec<(String, Tree)>),
}

impl Tree {
    pub fn new(line: u32, node: Node) -> Self {
        Self { line, node }
    }

    /// The entries of a table; of anything else none.
    pub fn entries(&self) -> &[(String, Self)] {
        match &self.node {
            Node::Table(entries) => entries,
            _ => &[],
        }
    }

    /// The first entry of that name.
    pub fn get(&self, name: &str) -> Option<&Self> {
        self.entries()
            .iter()
            .find(|(key, _)| key == name)
            .map(|(_, value)| value)
    }

    pub fn text(&self) -> Option<&str> {
        match &self.node {
            Node::Text(text) => Some(text),
            _ => None,
        }
    }

    pub fn number(&self) -> Option<f64> {
        match self.node {
            Node::Number(number) => Some(number),
            _ => None,
        }
    }

    /// The values that are no tables, with their whole names: `linear.x.max_velocity`.
    pub fn flat(&self) -> Vec<(String, &Self)> {
        let mut found = Vec::new();
        self.flatten("", &mut found);
        found
    }

    fn flatten<'a>(&'a self, prefix: &str, found: &mut Vec<(String, &'a Self)>) {
        for (key, value) in self.entries() {
            let name = if prefix.is_empty() {
                key.clone()
            } else {
                format!("{prefix}.{key}")
            };
            match &value.node {
                Node::Table(_) => value.flatten(&name, found),
                _ => found.push((name, value)),
            }
        }
    }
}
