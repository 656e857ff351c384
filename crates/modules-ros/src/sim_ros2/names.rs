//! Names of ROS 2, and how DDS calls them.

use ros_interfaces::TypeName;

/// Where names of a node belong.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Place {
    /// Empty, or begins with a slash and does not end with one.
    pub namespace: String,
    pub node: String,
}

impl Place {
    pub(super) fn new(namespace: &str, node: &str) -> Self {
        let trimmed = namespace.trim_matches('/');
        let namespace = if trimmed.is_empty() {
            String::new()
        } else {
            format!("/{trimmed}")
        };
        Self {
            namespace,
            node: node.to_string(),
        }
    }

    /// A name as all nodes know it: `/x` as it is, `x` in the namespace, `~/x` below the node.
    ///
    /// # Errors
    /// Why it is no name.
    pub(super) fn resolve(&self, name: &str) -> Result<String, String> {
        let full = match name.strip_prefix('~') {
            Some(rest) => format!("{}/{}{rest}", self.namespace, self.node),
            None if name.starts_with('/') => name.to_string(),
            None => format!("{}/{name}", self.namespace),
        };
        let is_word = |word: &str| {
            word.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
                && word.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
        };
        let is_valid = full.len() <= 247 && full.split('/').skip(1).all(is_word);
        if is_valid {
            Ok(full)
        } else {
            Err(format!("Invalid name: '{name}'"))
        }
    }
}

/// How DDS calls a topic.
pub(super) fn topic(full: &str) -> String {
    format!("rt{full}")
}

/// How DDS calls the topics of requests and replies of a service.
pub(super) fn service(full: &str) -> [String; 2] {
    [format!("rq{full}Request"), format!("rr{full}Reply")]
}

/// How DDS calls a type.
pub(super) fn type_name(name: &TypeName) -> String {
    format!(
        "{}::{}::dds_::{}_",
        name.package,
        name.kind.word(),
        name.name
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_resolved() {
        let place = Place::new("robots/r1/", "sim");
        assert_eq!(
            place.resolve("cmd_vel").as_deref(),
            Ok("/robots/r1/cmd_vel")
        );
        assert_eq!(place.resolve("/cmd_vel").as_deref(), Ok("/cmd_vel"));
        assert_eq!(
            place.resolve("~/state").as_deref(),
            Ok("/robots/r1/sim/state")
        );
        assert_eq!(Place::new("/", "sim").resolve("a/b").as_deref(), Ok("/a/b"));
        for bad in ["", "/", "a b", "1a", "a//b", "a/", "é"] {
            assert_eq!(
                place.resolve(bad),
                Err(format!("Invalid name: '{bad}'")),
                "{bad}"
            );
        }
    }
}
