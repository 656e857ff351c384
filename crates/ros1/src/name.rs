//! Names of nodes, topics, services and parameters.

use crate::{Error, Result};

/// Where the names of a node belong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    /// Empty, or begins with a slash and does not end with one.
    namespace: String,
    /// With the namespace.
    pub(crate) node: String,
}

impl Place {
    pub(crate) fn new(namespace: &str, node: &str) -> Result<Self> {
        let trimmed = namespace.trim_matches('/');
        let namespace = if trimmed.is_empty() {
            String::new()
        } else {
            format!("/{trimmed}")
        };
        let full = if node.starts_with('/') {
            node.to_string()
        } else {
            format!("{namespace}/{node}")
        };
        Ok(Self {
            namespace,
            node: checked(full, node)?,
        })
    }

    /// A name as all nodes know it: `/x` as it is, `x` in the namespace, `~x` below the node.
    pub(crate) fn resolve(&self, name: &str) -> Result<String> {
        let full = match name.strip_prefix('~') {
            Some(rest) => format!("{}/{}", self.node, rest.trim_start_matches('/')),
            None if name.starts_with('/') => name.to_string(),
            None => format!("{}/{name}", self.namespace),
        };
        checked(full, name)
    }
}

/// Without a slash at the end.
fn checked(full: String, name: &str) -> Result<String> {
    let full = full.trim_end_matches('/');
    let is_word = |word: &str| {
        word.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
            && word.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
    };
    let is_valid =
        full.len() <= 255 && full.starts_with('/') && full.split('/').skip(1).all(is_word);
    if is_valid {
        Ok(full.to_string())
    } else {
        Err(Error::Name(name.to_string()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_resolved() {
        let place = Place::new("robots/r1/", "sim").expect("a place");
        let resolve = |name: &str| place.resolve(name).expect("a name");
        assert_eq!(place.node, "/robots/r1/sim");
        assert_eq!(resolve("cmd_vel"), "/robots/r1/cmd_vel");
        assert_eq!(resolve("/cmd_vel/"), "/cmd_vel");
        assert_eq!(resolve("~gain"), "/robots/r1/sim/gain");
        assert_eq!(
            Place::new("", "sim")
                .expect("a place")
                .resolve("a/b")
                .expect("a name"),
            "/a/b"
        );
        for bad in ["/", "a b", "1a", "a//b", "é", "~ ", "a=b", "a\n"] {
            assert!(place.resolve(bad).is_err(), "{bad}");
        }
        assert!(Place::new("", "sim").expect("a place").resolve("").is_err());
        assert!(Place::new("", "no name").is_err());
    }
}
