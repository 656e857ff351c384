//! The options about what scripts may do.

use std::path::PathBuf;
use std::str::FromStr;

use permissions::{HostRule, Permissions};

/// Where the help text lists them.
pub(in crate::cli) const HEADING: &str =
    "Permissions of scripts and remote clients (default: everything)";

/// Permissions of scripts and remote clients: all without these options.
#[derive(Debug, Clone, Default, clap::Args)]
pub(in crate::cli) struct PermissionArgs {
    /// Allow reading the scene's folder, and nothing else but what other options allow
    #[arg(long, help_heading = HEADING)]
    no_unsafe: bool,
    /// Allow nothing, not even reading the scene's folder, but what other options allow
    #[arg(long, help_heading = HEADING, conflicts_with = "no_unsafe")]
    deny_all: bool,
    /// Allow reading files in DIR, or all files; may be repeated. This and the next four options imply --no-unsafe, unless --deny-all is given
    #[arg(long, help_heading = HEADING, value_name = "DIR", num_args = 0..=1, require_equals = true, default_missing_value = EVERYTHING, value_parser = scope::<PathBuf>)]
    allow_read: Vec<Scope<PathBuf>>,
    /// Allow writing files in DIR, or all files; may be repeated
    #[arg(long, help_heading = HEADING, value_name = "DIR", num_args = 0..=1, require_equals = true, default_missing_value = EVERYTHING, value_parser = scope::<PathBuf>)]
    allow_write: Vec<Scope<PathBuf>>,
    /// Allow connecting to and listening at HOST or HOST:PORT, or using the whole network; may be repeated
    #[arg(long, help_heading = HEADING, value_name = "HOST:PORT", num_args = 0..=1, require_equals = true, default_missing_value = EVERYTHING, value_parser = scope::<HostRule>)]
    allow_net: Vec<Scope<HostRule>>,
    /// Allow starting programs
    #[arg(long, help_heading = HEADING)]
    allow_run: bool,
    /// Allow native libraries and bytecode
    #[arg(long, help_heading = HEADING)]
    allow_native: bool,
}

/// Values of an option, or everything.
#[derive(Debug, Clone)]
enum Scope<T> {
    Everything,
    Only(T),
}

/// Stands for an option without a value. No command line can contain it: an empty value, as of a variable that is not set, is an error.
const EVERYTHING: &str = "\0";

fn scope<T: FromStr<Err: std::fmt::Display>>(text: &str) -> Result<Scope<T>, String> {
    match text {
        EVERYTHING => Ok(Scope::Everything),
        "" => Err("a value is needed after '='".into()),
        _ => text
            .parse()
            .map(Scope::Only)
            .map_err(|error: T::Err| error.to_string()),
    }
}

impl PermissionArgs {
    /// Whether some option was given.
    pub(in crate::cli) fn is_restricted(&self) -> bool {
        let is_listed = !(self.allow_read.is_empty()
            && self.allow_write.is_empty()
            && self.allow_net.is_empty());
        self.no_unsafe || self.deny_all || is_listed || self.allow_run || self.allow_native
    }

    /// The permissions, for a scene that is not known yet ([`Permissions::of_scene`]).
    pub(in crate::cli) fn permissions(&self) -> Permissions {
        if !self.is_restricted() {
            return Permissions::all();
        }
        let set = if self.deny_all {
            Permissions::none()
        } else {
            Permissions::strict()
        };
        let set = add(
            set,
            &self.allow_read,
            Permissions::allow_read_everywhere,
            |set, folder| set.allow_read(folder),
        );
        let set = add(
            set,
            &self.allow_write,
            Permissions::allow_write_everywhere,
            |set, folder| set.allow_write(folder),
        );
        let set = add(
            set,
            &self.allow_net,
            Permissions::allow_net_everywhere,
            |set, host| set.allow_net(host.clone()),
        );
        let set = if self.allow_run { set.allow_run() } else { set };
        if self.allow_native {
            set.allow_native()
        } else {
            set
        }
    }
}

fn add<T>(
    set: Permissions,
    scopes: &[Scope<T>],
    everything: fn(Permissions) -> Permissions,
    one: impl Fn(Permissions, &T) -> Permissions,
) -> Permissions {
    scopes.iter().fold(set, |set, scope| match scope {
        Scope::Everything => everything(set),
        Scope::Only(item) => one(set, item),
    })
}
