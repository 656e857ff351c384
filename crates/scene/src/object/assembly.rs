//! Assembly of models. Stored for files; there is no interactive assembly.

use crate::Pose;

/// How an object connects to another one when models are assembled.
#[derive(Debug, Clone, PartialEq)]
pub struct Assembly {
    /// Where the object goes in its new parent.
    pub pose: Pose,
    /// Whether it goes there, or stays where it is.
    pub moves: bool,
    /// As a child: a parent must have one of these words.
    pub child_words: Vec<String>,
    /// As a parent: the words of its own.
    pub parent_words: Vec<String>,
}

impl Assembly {
    /// The word that every object has at first.
    pub const WORD: &'static str = "default";
}

impl Default for Assembly {
    fn default() -> Self {
        let words = || vec![Self::WORD.to_owned()];
        Self {
            pose: Pose::identity(),
            moves: false,
            child_words: words(),
            parent_words: words(),
        }
    }
}
