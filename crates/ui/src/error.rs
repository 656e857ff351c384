//! Why something about windows is refused, in CoppeliaSim's words.

/// An error of a call about windows.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum UiError {
    /// No window has that handle.
    #[error("invalid object handle")]
    NoSuchWindow,
    /// No widget of the window has that id.
    #[error("invalid widget id: {0}")]
    NoSuchWidget(i64),
    /// The widget is of another type than this one.
    #[error("invalid widget type. expected {0} (in function getWidget())")]
    WidgetType(&'static str),
    /// The widget has no columns.
    #[error("invalid widget type. expected table or tree.")]
    NoColumns,
    /// The widget with that id shows no image.
    #[error("invalid image widget id: {0}")]
    NoImage(i64),
    /// The XML of a window is wrong: what, with the elements around it.
    #[error("{0}")]
    Xml(String),
    /// The pixels are not as many bytes as the size needs.
    #[error("bad image size. expected: {expected}. got: {found}.")]
    ImageSize {
        /// Bytes that the size needs.
        expected: usize,
        /// Bytes there are.
        found: usize,
    },
    /// A message of its own.
    #[error("{0}")]
    Other(String),
}

impl UiError {
    pub(super) fn other(text: impl Into<String>) -> Self {
        Self::Other(text.into())
    }
}

/// Result of a call about windows.
pub type UiResult<T> = Result<T, UiError>;
