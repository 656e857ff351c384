//! Why something about windows is refused, in CoppeliaSim's words.

/// An error of a call about windows.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum UiError {
    #[error("invalid object handle")]
    NoSuchWindow,
    #[error("invalid widget id: {0}")]
    NoSuchWidget(i64),
    #[error("invalid widget type. expected {0} (in function getWidget())")]
    WidgetType(&'static str),
    #[error("invalid widget type. expected table or tree.")]
    NoColumns,
    #[error("invalid image widget id: {0}")]
    NoImage(i64),
    /// The text of a window is wrong: what, with the elements around it.
    #[error("{0}")]
    Xml(String),
    #[error("bad image size. expected: {expected}. got: {found}.")]
    ImageSize { expected: usize, found: usize },
    #[error("{0}")]
    Other(String),
}

impl UiError {
    pub(super) fn other(text: impl Into<String>) -> Self {
        Self::Other(text.into())
    }
}

pub type UiResult<T> = Result<T, UiError>;
