//! Old-style names in the arguments of functions (spec: vrep-era 1.1).

use crate::Cx;
use scene::{Handle, Scene, SceneResult, name_suffix};

/// An old-style name as a script writes it: `arm`, `arm#` (no suffix), `arm#3`, with `@silentError` or `@alt`.
pub(crate) struct OldName {
    /// As it is in the scene.
    pub name: String,
    /// A missing name is no error.
    pub no_error: bool,
    /// The alternative name is meant.
    pub is_alternative: bool,
}

impl OldName {
    /// `suffix` is the number of the calling script, -1 without one.
    pub(crate) fn read(text: &str, suffix: i64) -> Self {
        let (name, _) = text.split_once('@').unwrap_or((text, ""));
        let is_alternative = text.contains("@alt");
        let name = if is_alternative {
            name.to_owned()
        } else {
            name_with_suffix(name, suffix)
        };
        Self {
            name,
            no_error: text.contains("@silentError"),
            is_alternative,
        }
    }

    /// The object of that name.
    pub(crate) fn find(&self, scene: &Scene) -> SceneResult<Handle> {
        if self.is_alternative {
            scene.find_alternative_name(&self.name)
        } else {
            scene.find_old_name(&self.name)
        }
    }
}

/// The name in the scene of what a script with a number calls `name`: without a `#` it takes the number, and one at the end is dropped.
pub(crate) fn name_with_suffix(name: &str, suffix: i64) -> String {
    match name.strip_suffix('#') {
        Some(stem) => stem.to_owned(),
        None if suffix >= 0 && !name.contains('#') => format!("{name}#{suffix}"),
        None => name.to_owned(),
    }
}

/// The number in the old name of the calling script's object; -1 without one.
pub(crate) fn suffix_of_script(cx: &Cx) -> i64 {
    let scene = cx.scene();
    let object = cx
        .script()
        .owner()
        .or(cx.script().object)
        .and_then(|object| scene.object(object).ok());
    object.map_or(-1, |object| name_suffix(object.old_name()).0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_take_the_suffix_of_the_script() {
        let name = |text, suffix| OldName::read(text, suffix).name;
        assert_eq!(name("arm", -1), "arm");
        assert_eq!(name("arm", 3), "arm#3");
        assert_eq!(
            [name("arm#", 3), name("arm#0", 3), name("arm#", -1)],
            ["arm", "arm#0", "arm"]
        );
        assert_eq!(name("arm@silentError", 3), "arm#3");
        assert!(OldName::read("arm@silentError", 3).no_error);
    }
}
