//! The modules that `require` finds in CoppeliaSim, whether they are here or not.

/// One line for each: name, kind, what it is for, what to use instead.
const TABLE: &str = include_str!("reference_modules.tsv");

/// A plugin or Lua module of CoppeliaSim.
#[derive(Debug, Clone, Copy)]
pub struct ReferenceModule {
    /// The name by which `require` finds it in CoppeliaSim.
    pub name: &'static str,
    /// `plugin`, `library` or `third-party library`.
    pub kind: &'static str,
    /// What it is for, in one line.
    pub purpose: &'static str,
    /// Its replacement; empty without one.
    pub instead: &'static str,
}

impl ReferenceModule {
    /// All modules of the list, in its order.
    pub fn all() -> impl Iterator<Item = Self> {
        TABLE.lines().map(|line| {
            let mut columns = line.split('\t');
            let mut next = || columns.next().unwrap_or_default();
            Self {
                name: next(),
                kind: next(),
                purpose: next(),
                instead: next(),
            }
        })
    }

    /// Whether it is the second generation of a plugin, which works with objects instead of handles.
    pub fn is_later(self) -> bool {
        self.kind == "plugin" && self.name.ends_with("-2")
    }

    /// The error for a script that requires a module that is missing here.
    pub(crate) fn missing(self) -> String {
        let what = if self.kind == "plugin" {
            "plugin"
        } else {
            "Lua module"
        };
        if self.is_later() {
            return format!(
                "{} belongs to CoppeliaSim 4.11, the version after 4.10, whose interface is here; use {}",
                self.name,
                self.instead.replace('`', "")
            );
        }
        format!(
            "{} is a {what} of CoppeliaSim that Swanilda does not have yet (docs/PLUGINS.md)",
            self.name
        )
    }
}

#[cfg(test)]
mod tests {
    use super::ReferenceModule;

    #[test]
    fn every_line_is_complete() {
        let all: Vec<_> = ReferenceModule::all().collect();
        assert!(all.iter().any(|module| module.name == "simIK"));
        for module in all {
            assert!(
                ["plugin", "library", "third-party library"].contains(&module.kind),
                "{}",
                module.name
            );
            assert!(!module.purpose.is_empty(), "{}", module.name);
        }
    }
}
