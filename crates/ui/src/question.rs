//! Dialogs that wait for a person: what pages show of them, and the answers that pages send.

use serde_json::{Value, json};

use super::dialogs::DialogKind;
use scene::Data;

/// A dialog that waits.
#[derive(Debug, Clone, PartialEq)]
pub struct Question {
    /// The title of its window.
    pub title: String,
    /// What it says.
    pub text: String,
    /// What it asks for.
    pub details: QuestionDetails,
}

/// What a dialog asks for.
#[derive(Debug, Clone, PartialEq)]
pub enum QuestionDetails {
    /// One of several buttons.
    Message {
        /// Keys of the buttons, e.g. `yes`.
        buttons: Vec<&'static str>,
        /// The button that Enter presses.
        default_button: &'static str,
        /// `simUI.msgbox_type`.
        level: i64,
    },
    /// Names of files or of a folder.
    Files {
        /// `simUI.filedialog_type`.
        selects: i64,
        /// The folder to begin in.
        start_path: String,
        /// A name to begin with.
        initial_name: String,
        /// What the extensions are called.
        extension_name: String,
        /// With semicolons between them.
        extensions: String,
    },
    /// A colour.
    Color {
        /// Red, green, blue, 0 to 1, and opacity with `alpha`.
        initial: Vec<f64>,
        /// Whether an opacity is asked for.
        alpha: bool,
    },
    /// A line of text.
    Text {
        /// The text to begin with.
        initial: String,
    },
}

impl QuestionDetails {
    /// A file to load, of any kind.
    pub fn any_file() -> Self {
        let none = String::new;
        Self::Files {
            selects: 0,
            start_path: none(),
            initial_name: none(),
            extension_name: none(),
            extensions: none(),
        }
    }
}

impl Question {
    /// Its kind.
    pub fn kind(&self) -> DialogKind {
        match self.details {
            QuestionDetails::Message { .. } => DialogKind::Message,
            QuestionDetails::Files { .. } => DialogKind::File,
            QuestionDetails::Color { .. } => DialogKind::Color,
            QuestionDetails::Text { .. } => DialogKind::Input,
        }
    }

    /// As pages get it (docs/VIEW_PROTOCOL.md).
    pub fn json(&self, number: u64) -> Value {
        let mut all = json!({"number": number, "kind": self.kind().name(), "title": self.title, "text": self.text});
        let details = match &self.details {
            QuestionDetails::Message {
                buttons,
                default_button,
                level,
            } => {
                json!({"buttons": buttons, "usual": default_button, "type": level})
            }
            QuestionDetails::Files {
                selects,
                start_path,
                initial_name,
                extension_name,
                extensions,
            } => json!({
                "type": selects, "startPath": start_path, "initName": initial_name, "extName": extension_name,
                "extensions": extensions,
            }),
            QuestionDetails::Color { initial, alpha } => {
                json!({"initial": initial, "alpha": alpha})
            }
            QuestionDetails::Text { initial } => json!({"initial": initial}),
        };
        if let (Value::Object(all), Value::Object(details)) = (&mut all, details) {
            all.extend(details);
        }
        all
    }
}

/// What a page answers: texts, numbers, and lists of them. None for null and for what is no answer.
pub fn answer_of_page(answer: &Value) -> Option<Data> {
    match answer {
        Value::String(text) => Some(Data::text(text)),
        Value::Number(number) => number
            .as_i64()
            .map(Data::Int)
            .or_else(|| number.as_f64().map(Data::Float)),
        Value::Array(items) => items
            .iter()
            .map(answer_of_page)
            .collect::<Option<Vec<_>>>()
            .map(Data::Array),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_get_what_is_asked_for() {
        let details = QuestionDetails::Message {
            buttons: vec!["yes", "no"],
            default_button: "no",
            level: 1,
        };
        let question = Question {
            title: "a".into(),
            text: "<b>".into(),
            details,
        };
        let expected = json!({
            "number": 3, "kind": "msgBox", "title": "a", "text": "<b>", "buttons": ["yes", "no"], "usual": "no", "type": 1,
        });
        assert_eq!(question.json(3), expected);
    }

    #[test]
    fn answers_are_texts_numbers_and_lists() {
        assert_eq!(answer_of_page(&json!("ok")), Some(Data::text("ok")));
        assert_eq!(
            answer_of_page(&json!([0, 0.5])),
            Some(Data::Array(vec![Data::Int(0), Data::Float(0.5)]))
        );
        for wrong in [json!(null), json!(true), json!({"a": 1}), json!([1, null])] {
            assert_eq!(answer_of_page(&wrong), None, "{wrong}");
        }
    }
}
