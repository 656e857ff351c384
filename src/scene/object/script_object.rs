//! Scripts as scene objects: text and flags. Running them is the business of `crate::script`.

/// `sim.scripttype_*`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ScriptType {
    Main = 0,
    Simulation = 1,
    AddOn = 2,
    Customization = 6,
    Sandbox = 8,
    Passive = 9,
}

impl ScriptType {
    /// The type with number `n`.
    pub fn from_number(n: i64) -> Option<Self> {
        [Self::Main, Self::Simulation, Self::AddOn, Self::Customization, Self::Sandbox, Self::Passive]
            .into_iter()
            .find(|t| *t as i64 == n)
    }
}

/// The text of a script and how it is to be run.
#[derive(Debug, Clone, PartialEq)]
pub struct ScriptObject {
    pub script_type: ScriptType,
    pub code: Vec<u8>,
    /// The file the text is from, as stack traces name it; none for a text that only the scene has.
    pub source: Option<String>,
    pub language: String,
    pub disabled: bool,
    pub restart_on_error: bool,
    pub reset_after_sim_error: bool,
    /// `./x` and `.` start at the parent: set for scripts converted from the associated form.
    pub parent_is_proxy: bool,
    /// Display size, metres.
    pub size: f64,
}

impl ScriptObject {
    /// A script as `sim.createScript` makes it: only Lua simulation and customization scripts start enabled.
    pub fn new(script_type: ScriptType, code: Vec<u8>, language: &str, disabled: bool) -> Self {
        let runs = matches!(script_type, ScriptType::Simulation | ScriptType::Customization);
        Self {
            script_type,
            code,
            source: None,
            language: language.to_owned(),
            disabled: disabled || !runs || !matches!(language, "lua" | "python"),
            restart_on_error: false,
            reset_after_sim_error: false,
            parent_is_proxy: false,
            size: 0.01,
        }
    }
}
