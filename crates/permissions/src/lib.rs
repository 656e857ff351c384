//! Permissions of scripts: files, programs, the network, native code.
//!
//! Whoever calls the operating system for a script asks here first, with what the call is going to be made with. Values, cheap to
//! clone; a simulator has one for all its scripts (`Options::permissions`). With them goes the tape of the simulator, on which what is read of files is
//! captured and replayed.
//!
//! A path is judged by where it leads: links and `..` are followed first (`resolve`). Between that and the call nothing a restricted
//! script can do makes the path lead elsewhere, since it can neither make symbolic links nor change the working directory. Not covered:
//! other programs that swap links meanwhile, and what a permission itself brings along (a program or a library may do anything).

mod bounded;
mod files;
mod network;
mod resolve;

use std::fmt;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use capture::Tape;

pub use bounded::read_bounded;
pub use network::HostRule;
pub use resolve::c_path;
use resolve::{resolve, resolve_entry};

/// Permissions of scripts; see the methods named `allow_`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Permissions {
    read: Scope<PathBuf>,
    write: Scope<PathBuf>,
    network: Scope<HostRule>,
    run: bool,
    native: bool,
    reads_scene_folder: bool,
    tape: Tape,
}

/// Everything, or what is listed.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Scope<T> {
    Everything,
    Only(Arc<Vec<T>>),
}

impl<T: Clone> Scope<T> {
    /// The same, counted apart.
    fn counted_apart(&self) -> Self {
        match self {
            Self::Everything => Self::Everything,
            Self::Only(items) => Self::Only(Arc::new(items.to_vec())),
        }
    }

    fn nothing() -> Self {
        Self::Only(Arc::default())
    }

    fn add(&mut self, item: T) {
        if let Self::Only(items) = self {
            Arc::make_mut(items).push(item);
        }
    }
}

impl Default for Permissions {
    /// As in CoppeliaSim: everything.
    fn default() -> Self {
        Self::all()
    }
}

impl Permissions {
    /// The same, with nothing that is counted in common: for the memory of a simulator, which is brought back with its counts.
    pub fn counted_apart(&self) -> Self {
        Self {
            read: self.read.counted_apart(),
            write: self.write.counted_apart(),
            network: self.network.counted_apart(),
            tape: self.tape.counted_apart(),
            ..*self
        }
    }

    /// Everything.
    pub fn all() -> Self {
        Self {
            read: Scope::Everything,
            write: Scope::Everything,
            network: Scope::Everything,
            run: true,
            native: true,
            reads_scene_folder: true,
            tape: Tape::default(),
        }
    }

    /// Nothing.
    pub fn none() -> Self {
        Self {
            read: Scope::nothing(),
            write: Scope::nothing(),
            network: Scope::nothing(),
            run: false,
            native: false,
            reads_scene_folder: false,
            tape: Tape::default(),
        }
    }

    /// Nothing but to read the folder of the scene (`--no-unsafe`), which [`of_scene`](Self::of_scene) names.
    pub fn strict() -> Self {
        Self {
            reads_scene_folder: true,
            ..Self::none()
        }
    }

    /// The same on a tape: what is read of files by these permissions is captured, or replayed.
    #[must_use]
    pub fn on_tape(self, tape: &Tape) -> Self {
        Self {
            tape: tape.clone(),
            ..self
        }
    }

    /// The tape on which everything comes from outside.
    pub fn tape(&self) -> &Tape {
        &self.tape
    }

    /// The same for a scene in `folder`, which can be read where the set says so.
    #[must_use]
    pub fn of_scene(self, folder: &Path) -> Self {
        if self.reads_scene_folder {
            self.allow_read(folder)
        } else {
            self
        }
    }

    /// Files in `folder` can be read; or one file.
    #[must_use]
    pub fn allow_read(mut self, folder: impl AsRef<Path>) -> Self {
        self.read.add(root(folder.as_ref()));
        self
    }

    /// All files can be read, and the environment.
    #[must_use]
    pub fn allow_read_everywhere(self) -> Self {
        Self {
            read: Scope::Everything,
            ..self
        }
    }

    /// Files in `folder` can be written, made and removed; or one file.
    #[must_use]
    pub fn allow_write(mut self, folder: impl AsRef<Path>) -> Self {
        self.write.add(root(folder.as_ref()));
        self
    }

    /// All files can be written: as good as everything.
    #[must_use]
    pub fn allow_write_everywhere(self) -> Self {
        Self {
            write: Scope::Everything,
            ..self
        }
    }

    /// Programs can be started: as good as everything, since a program is not restricted.
    #[must_use]
    pub fn allow_run(self) -> Self {
        Self { run: true, ..self }
    }

    /// Connections to a host, and servers at an address, are possible.
    #[must_use]
    pub fn allow_net(mut self, host: HostRule) -> Self {
        self.network.add(host);
        self
    }

    /// The whole network can be used.
    #[must_use]
    pub fn allow_net_everywhere(self) -> Self {
        Self {
            network: Scope::Everything,
            ..self
        }
    }

    /// Native libraries and bytecode can be loaded: as good as everything, since native code is not restricted.
    #[must_use]
    pub fn allow_native(self) -> Self {
        Self {
            native: true,
            ..self
        }
    }

    /// Whether nothing is refused.
    pub fn is_all(&self) -> bool {
        let is_open = self.reads_everything()
            && self.writes_everything()
            && matches!(self.network, Scope::Everything);
        is_open && self.run && self.native
    }

    /// Whether programs can be started.
    pub fn can_run(&self) -> bool {
        self.run
    }

    /// Whether native libraries and bytecode can be loaded.
    pub fn can_load_native(&self) -> bool {
        self.native
    }

    fn reads_everything(&self) -> bool {
        matches!(self.read, Scope::Everything)
    }

    fn writes_everything(&self) -> bool {
        matches!(self.write, Scope::Everything)
    }
}

/// # Errors
/// An error that names the refused action and the option that allows it.
impl Permissions {
    /// A file is read.
    pub fn check_read(&self, path: &Path) -> Result<(), Denied> {
        READ.check(&self.tape, &self.read, path, resolve, Path::parent)
    }

    /// The names in a folder, or what is known of a path, are read.
    pub fn check_inspect(&self, path: &Path) -> Result<(), Denied> {
        READ.check(&self.tape, &self.read, path, resolve, itself)
    }

    /// A symbolic link is read, not followed.
    pub fn check_inspect_link(&self, path: &Path) -> Result<(), Denied> {
        READ.check(&self.tape, &self.read, path, resolve_entry, itself)
    }

    /// A file is made or changed.
    pub fn check_write(&self, path: &Path) -> Result<(), Denied> {
        WRITE.check(&self.tape, &self.write, path, resolve, Path::parent)
    }

    /// An entry of a folder is made, removed or renamed; where a link leads does not matter.
    pub fn check_write_entry(&self, path: &Path) -> Result<(), Denied> {
        WRITE.check(&self.tape, &self.write, path, resolve_entry, Path::parent)
    }

    /// An entry of a folder gets another place, where it may be read.
    pub fn check_rename(&self, old: &Path, new: &Path) -> Result<(), Denied> {
        self.check_inspect_link(old)?;
        self.check_write_entry(old)?;
        self.check_write_entry(new)
    }

    /// A socket or a device, which is read and written.
    pub fn check_device(&self, path: &Path) -> Result<(), Denied> {
        READ.check(&self.tape, &self.read, path, resolve, itself)?;
        WRITE.check(&self.tape, &self.write, path, resolve, itself)
    }

    /// Something changes where other paths lead: a symbolic link, the working directory.
    pub fn check_redirect(&self, what: &str) -> Result<(), Denied> {
        let is_free = self.reads_everything() && self.writes_everything();
        if is_free {
            Ok(())
        } else {
            Err(Denied(format!(
                "{what} is not allowed: run with --allow-read --allow-write"
            )))
        }
    }

    /// The environment of the process is read.
    pub fn check_environment(&self) -> Result<(), Denied> {
        let denied =
            || Denied("reading the environment is not allowed: run with --allow-read".into());
        if self.reads_everything() {
            Ok(())
        } else {
            Err(denied())
        }
    }

    /// A program is started.
    pub fn check_run(&self, program: &str) -> Result<(), Denied> {
        let denied = || {
            Denied(format!(
                "running '{program}' is not allowed: run with --allow-run"
            ))
        };
        if self.run { Ok(()) } else { Err(denied()) }
    }

    /// Native code is loaded: a library, bytecode.
    pub fn check_native(&self, what: &str) -> Result<(), Denied> {
        let denied = || Denied(format!("{what} is not allowed: run with --allow-native"));
        if self.native { Ok(()) } else { Err(denied()) }
    }

    /// A host is connected to, or an address listened at; without a port, its name or address is asked for.
    pub fn check_net(&self, host: &str, port: Option<u16>) -> Result<(), Denied> {
        match &self.network {
            Scope::Everything => Ok(()),
            Scope::Only(rules) if rules.iter().any(|rule| rule.admits(host, port)) => Ok(()),
            Scope::Only(_) => {
                let place = network::place(host, port);
                Err(Denied(format!(
                    "the network at '{place}' is not allowed: run with --allow-net={place}"
                )))
            }
        }
    }

    /// A use of the network that no host stands for.
    pub fn check_net_everywhere(&self, what: &str) -> Result<(), Denied> {
        let denied = || Denied(format!("{what} is not allowed: run with --allow-net"));
        if matches!(self.network, Scope::Everything) {
            Ok(())
        } else {
            Err(denied())
        }
    }
}

/// Something scripts may not do, in words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Denied(String);

impl Denied {
    /// The system's number for a lack of permission, as in C.
    pub const ERRNO: i32 = 13;
}

impl fmt::Display for Denied {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Denied {}

impl From<Denied> for std::io::Error {
    fn from(denied: Denied) -> Self {
        Self::new(std::io::ErrorKind::PermissionDenied, denied)
    }
}

/// A folder as paths are compared with it. What cannot be followed stays as it is, and nothing lies in it.
fn root(folder: &Path) -> PathBuf {
    resolve(folder).unwrap_or_else(|_| folder.to_owned())
}

/// The path without `..`, where that leads to the same place.
fn without_dots(path: PathBuf) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => drop(plain.pop()),
            part => plain.push(part),
        }
    }
    if resolve(&plain).ok() == resolve(&path).ok() {
        plain
    } else {
        path
    }
}

fn itself(path: &Path) -> Option<&Path> {
    Some(path)
}

/// A kind of access to files, and the option that allows it.
struct Access {
    doing: &'static str,
    option: &'static str,
}

const READ: Access = Access {
    doing: "reading",
    option: "--allow-read",
};
const WRITE: Access = Access {
    doing: "writing",
    option: "--allow-write",
};

impl Access {
    /// `suggested` says which part of the path the option would name.
    fn check(
        &self,
        tape: &Tape,
        scope: &Scope<PathBuf>,
        path: &Path,
        follow: fn(&Path) -> std::io::Result<PathBuf>,
        suggested: fn(&Path) -> Option<&Path>,
    ) -> Result<(), Denied> {
        let Scope::Only(roots) = scope else {
            return Ok(());
        };
        // Where links lead is the system's to say.
        let checked = tape.input("permission", || {
            let checked = self.check_roots(roots, path, follow, suggested);
            checked.map_err(|denied| denied.0)
        });
        checked
            .unwrap_or_else(|lost| Err(lost.to_string()))
            .map_err(Denied)
    }

    fn check_roots(
        &self,
        roots: &[PathBuf],
        path: &Path,
        follow: fn(&Path) -> std::io::Result<PathBuf>,
        suggested: fn(&Path) -> Option<&Path>,
    ) -> Result<(), Denied> {
        let is_allowed = |resolved: PathBuf| roots.iter().any(|root| resolved.starts_with(root));
        // The system refuses an empty name itself.
        if path.as_os_str().is_empty() || follow(path).is_ok_and(is_allowed) {
            return Ok(());
        }
        let absolute = without_dots(std::path::absolute(path).unwrap_or_else(|_| path.to_owned()));
        // The link lies in an allowed folder, but its target does not exist.
        let folder = suggested(&absolute).filter(|folder| !resolve(folder).is_ok_and(is_allowed));
        Err(self.denied(path, folder.unwrap_or(&absolute)))
    }

    /// Paths stand as the script has named them: where links lead is not the script's to know.
    fn denied(&self, path: &Path, allowed: &Path) -> Denied {
        let Self { doing, option } = self;
        Denied(format!(
            "{doing} '{}' is not allowed: run with {option}={}",
            path.display(),
            allowed.display()
        ))
    }
}

#[cfg(test)]
mod tests;
