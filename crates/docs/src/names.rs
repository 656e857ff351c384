//! The names that editors offer while a script is written.

use ::modules::ALL;
use script::pairs;

use crate::callbacks;

/// The constants of `sim` and of the modules: module and name.
pub fn constants() -> impl Iterator<Item = (&'static str, &'static str)> {
    let own = pairs(api::SIM.constants).map(|(name, _)| ("sim", name));
    own.chain(
        ALL.iter()
            .flat_map(|module| pairs(module.constants).map(|(name, _)| (module.name, name))),
    )
}

/// The callbacks of scripts: name, how a script defines it, when it is called.
pub fn callback_summaries() -> impl Iterator<Item = (&'static str, String, &'static str)> {
    callbacks::summaries()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_and_callbacks_have_their_names() {
        assert!(constants().any(|constant| constant == ("sim", "handle_world")));
        assert!(constants().any(|(module, _)| module == "simIK"));
        let joint = callback_summaries().find(|(name, _, _)| *name == "sysCall_joint");
        let (_, signature, when) = joint.expect("joints have a callback");
        assert_eq!(signature, "function sysCall_joint(inData)");
        assert!(!when.is_empty());
    }
}
