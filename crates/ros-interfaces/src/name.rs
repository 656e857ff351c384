//! Names of interfaces.

use std::fmt;

use crate::InterfaceError;

/// What a text describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum InterfaceKind {
    /// One structure.
    Message,
    /// A request and a response.
    Service,
    /// A goal, a result and feedback.
    Action,
}

impl InterfaceKind {
    /// All kinds.
    pub const ALL: [Self; 3] = [Self::Message, Self::Service, Self::Action];

    /// The middle of a name, which is also the name of the folder and the extension of the file.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Message => "msg",
            Self::Service => "srv",
            Self::Action => "action",
        }
    }

    /// The kind with this word.
    #[must_use]
    pub fn of_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.word() == word)
    }

    /// How many structures a text of this kind has.
    #[must_use]
    pub fn parts(self) -> usize {
        match self {
            Self::Message => 1,
            Self::Service => 2,
            Self::Action => 3,
        }
    }
}

/// The name of an interface: `geometry_msgs/msg/Pose`.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TypeName {
    /// `geometry_msgs`.
    pub package: String,
    /// `msg`.
    pub kind: InterfaceKind,
    /// `Pose`.
    pub name: String,
}

impl TypeName {
    /// # Errors
    /// If a part is not a word of letters, digits and underscores.
    pub fn new(package: &str, kind: InterfaceKind, name: &str) -> Result<Self, InterfaceError> {
        if !(is_identifier(package) && is_identifier(name)) {
            return Err(InterfaceError::Name(format!(
                "{package}/{}/{name}",
                kind.word()
            )));
        }
        Ok(Self {
            package: package.into(),
            kind,
            name: name.into(),
        })
    }

    /// From `package/msg/Name`, or `package/Name`, which is of the kind `otherwise`.
    ///
    /// # Errors
    /// If it has another form.
    pub fn parse(text: &str, otherwise: InterfaceKind) -> Result<Self, InterfaceError> {
        let wrong = || InterfaceError::Name(text.into());
        let parts: Vec<&str> = text.split('/').collect();
        match parts[..] {
            [package, name] => Self::new(package, otherwise, name).map_err(|_| wrong()),
            [package, kind, name] => {
                let kind = InterfaceKind::of_word(kind).ok_or_else(wrong)?;
                Self::new(package, kind, name).map_err(|_| wrong())
            }
            _ => Err(wrong()),
        }
    }

    /// `geometry_msgs/Pose`, as ROS 1 writes it.
    #[must_use]
    pub fn short(&self) -> String {
        format!("{}/{}", self.package, self.name)
    }
}

impl fmt::Display for TypeName {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}/{}/{}", self.package, self.kind.word(), self.name)
    }
}

/// Whether it is a letter or underscore, then letters, digits and underscores; at most 255 of them.
pub(crate) fn is_identifier(word: &str) -> bool {
    let starts = word.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    starts && word.len() <= 255 && word.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_')
}
