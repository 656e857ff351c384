//! What a server offers: tools and resources.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};

use super::progress::Progress;

/// Tools and resources behind the protocol.
pub trait Service {
    /// Who it is.
    fn about(&self) -> About;

    /// All tools; the list does not change.
    fn tools(&self) -> &[Tool];

    /// Calls a tool of the list. What goes wrong in it is an answer too, for the model to read. A call that takes long says how far it is.
    fn call(&mut self, tool: &str, arguments: &Value, progress: &Progress) -> Answer;

    /// What can be read now.
    fn resources(&mut self) -> Vec<Resource>;

    /// Forms of addresses of what can be read.
    fn templates(&self) -> Vec<Template>;

    /// Reads a resource.
    ///
    /// # Errors
    /// When there is none.
    fn read(&mut self, uri: &str) -> Result<Contents, NotFound>;
}

/// The name of a server, and how a model is to use it.
#[derive(Debug, Clone)]
pub struct About {
    /// For programs.
    pub name: &'static str,
    /// For people.
    pub title: &'static str,
    /// Of the server.
    pub version: &'static str,
    /// For models.
    pub instructions: String,
}

/// Something that a model may call.
#[derive(Debug, Clone)]
pub struct Tool {
    /// Lower-case words with `_` between them.
    pub name: &'static str,
    /// For people.
    pub title: &'static str,
    /// For models.
    pub description: String,
    /// A JSON schema of an object.
    pub arguments: Value,
    /// Whether it changes nothing.
    pub reads_only: bool,
}

/// What a tool has to say.
#[derive(Debug, Clone, Default)]
pub struct Answer {
    /// Texts and pictures in order.
    pub content: Vec<Content>,
    /// The same for programs, if there is more to it than a text.
    pub structured: Option<Value>,
    /// Whether the tool could not do what was asked.
    pub is_error: bool,
}

/// A part of an answer.
#[derive(Debug, Clone)]
pub enum Content {
    /// A text.
    Text(String),
    /// A picture in a PNG file.
    Png(Vec<u8>),
}

/// Something that can be read.
#[derive(Debug, Clone)]
pub struct Resource {
    /// Its address.
    pub uri: String,
    /// For programs and people.
    pub name: String,
    /// What it is.
    pub description: String,
    /// Such as `text/plain`.
    pub mime_type: &'static str,
}

/// Addresses of a form.
#[derive(Debug, Clone)]
pub struct Template {
    /// The form, by RFC 6570.
    pub uri: &'static str,
    /// For programs and people.
    pub name: &'static str,
    /// What is found there.
    pub description: &'static str,
    /// Such as `text/plain`.
    pub mime_type: &'static str,
}

/// The text of a resource.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Contents {
    /// Such as `text/plain`.
    pub mime_type: &'static str,
    /// The text.
    pub text: String,
}

/// There is no such resource; the text says what there is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NotFound(pub String);

impl Answer {
    /// An answer of one text.
    pub fn text(text: impl Into<String>) -> Self {
        Self {
            content: vec![Content::Text(text.into())],
            ..Self::default()
        }
    }

    /// What was wrong, and the next step.
    pub fn error(text: impl Into<String>) -> Self {
        Self {
            is_error: true,
            ..Self::text(text)
        }
    }

    /// The same with another text at its end; without one it is not changed.
    #[must_use]
    pub fn and_text(mut self, text: &str) -> Self {
        if !text.is_empty() {
            self.content.push(Content::Text(text.to_owned()));
        }
        self
    }

    /// The same with values for programs.
    #[must_use]
    pub fn with(self, structured: Value) -> Self {
        Self {
            structured: Some(structured),
            ..self
        }
    }

    /// The same with a picture in a PNG file.
    #[must_use]
    pub fn and_png(mut self, file: Vec<u8>) -> Self {
        self.content.push(Content::Png(file));
        self
    }

    pub(crate) fn json(&self) -> Value {
        let content: Vec<Value> = self.content.iter().map(Content::json).collect();
        let mut answer = json!({"content": content, "isError": self.is_error});
        if let Some(structured) = &self.structured {
            answer["structuredContent"] = structured.clone();
        }
        answer
    }
}

impl Content {
    fn json(&self) -> Value {
        match self {
            Self::Text(text) => json!({"type": "text", "text": text}),
            Self::Png(bytes) => {
                json!({"type": "image", "data": BASE64_STANDARD.encode(bytes), "mimeType": "image/png"})
            }
        }
    }
}

impl Tool {
    pub(crate) fn json(&self) -> Value {
        json!({
            "name": self.name,
            "title": self.title,
            "description": self.description,
            "inputSchema": self.arguments,
            "annotations": {"readOnlyHint": self.reads_only, "openWorldHint": false},
        })
    }
}

impl Resource {
    pub(crate) fn json(&self) -> Value {
        json!({"uri": self.uri, "name": self.name, "description": self.description, "mimeType": self.mime_type})
    }
}

impl Template {
    pub(crate) fn json(&self) -> Value {
        json!({"uriTemplate": self.uri, "name": self.name, "description": self.description, "mimeType": self.mime_type})
    }
}
