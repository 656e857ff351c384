//! `swanilda library`: a folder that programs take for an installation of CoppeliaSim.

use std::fs::{self, Permissions};
use std::io;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::{Outcome, say};

/// What programs link against and load, and what is behind it.
const FRONT: &str = "libcoppeliaSim.so";
const SIMULATOR: &str = "libswanilda_library.so";

/// How programs start the executable by another program than themselves.
const LAUNCHER: &str = r#"#!/bin/sh
# Starts Swanilda with the options of CoppeliaSim's executable.
exec "$(dirname "$(readlink -f "$0")")/swanilda" coppeliasim "$@"
"#;

/// Write a folder for COPPELIASIM_ROOT: the simulator as the library that programs for CoppeliaSim load
#[derive(clap::Args)]
pub(super) struct Args {
    /// Folder to write into
    folder: PathBuf,
    /// Version of CoppeliaSim that the programs were made for
    #[arg(long = "for", value_name = "VERSION", default_value = "4.1")]
    release: Version,
    /// The library of the simulator [default: libswanilda_library.so beside this program or in ../lib/swanilda]
    #[arg(long, value_name = "FILE")]
    simulator: Option<PathBuf>,
    /// Leave out the command and coppeliaSim.sh, for small containers
    #[arg(long)]
    without_command: bool,
}

/// What CoppeliaSim's Python package looks for in the folder of Python files: the types in the first lines of functions' descriptions.
const CALLTIP: &str = include_str!("calltip.py");

/// The versions of CoppeliaSim's library.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum Version {
    /// Numbers in single precision: PyRep, RLBench.
    #[value(name = "4.1")]
    V41,
    /// Numbers in double precision: CoppeliaSim's own Python package.
    #[value(name = "4.10")]
    V410,
}

impl Version {
    fn front(self) -> &'static [u8] {
        match self {
            Self::V41 => c_interface::LIBRARY_41,
            Self::V410 => c_interface::LIBRARY_410,
        }
    }
}

pub(super) fn library(args: &Args) -> Outcome {
    if args.release.front().is_empty() {
        return Err("the library is there on Linux only".to_owned());
    }
    let program =
        std::env::current_exe().map_err(|error| format!("where is this program? {error}"))?;
    let simulator = match &args.simulator {
        Some(file) => file.clone(),
        None => found(&program)?,
    };
    fill(args, &program, &simulator)
        .map_err(|error| format!("cannot write to {}: {error}", args.folder.display()))?;
    let folder = std::path::absolute(&args.folder).unwrap_or_else(|_| args.folder.clone());
    let folder = folder.display();
    say(format!("wrote {folder}\n\nexport COPPELIASIM_ROOT={folder}\nexport LD_LIBRARY_PATH=$COPPELIASIM_ROOT:$LD_LIBRARY_PATH\n").as_bytes());
    Ok(ExitCode::SUCCESS)
}

/// The library of the simulator, where it is installed with the program.
fn found(program: &Path) -> Result<PathBuf, String> {
    let program = program
        .canonicalize()
        .unwrap_or_else(|_| program.to_owned());
    let folder = program.parent().unwrap_or(Path::new("/"));
    let places = [
        folder.join(SIMULATOR),
        folder.join("../lib/swanilda").join(SIMULATOR),
    ];
    let place = places.iter().find(|place| place.is_file());
    place.cloned().ok_or_else(|| {
        format!(
            "{SIMULATOR} is not beside {}: build it with `cargo build --release -p swanilda-library`, or name it with --simulator",
            program.display()
        )
    })
}

fn fill(args: &Args, program: &Path, simulator: &Path) -> io::Result<()> {
    let folder = &args.folder;
    // Programs keep their settings here.
    fs::create_dir_all(folder.join("system"))?;
    fs::create_dir_all(folder.join("python"))?;
    put(&folder.join("python/calltip.py"), 0o644, |file| {
        fs::write(file, CALLTIP)
    })?;
    put(&folder.join(FRONT), 0o755, |file| {
        fs::write(file, args.release.front())
    })?;
    for name in ["libcoppeliaSim.so.1", "libcoppeliaSimHeadless.so"] {
        link(FRONT, &folder.join(name))?;
    }
    put(&folder.join(SIMULATOR), 0o755, |file| {
        fs::copy(simulator, file).map(drop)
    })?;
    if args.without_command {
        return Ok(());
    }
    put_command(folder, program)
}

/// The command, and how other programs start it.
fn put_command(folder: &Path, program: &Path) -> io::Result<()> {
    put(&folder.join("swanilda"), 0o755, |file| {
        fs::copy(program, file).map(drop)
    })?;
    put(&folder.join("coppeliaSim.sh"), 0o755, |file| {
        fs::write(file, LAUNCHER)
    })?;
    for name in ["coppeliaSim", "vrep.sh"] {
        link("coppeliaSim.sh", &folder.join(name))?;
    }
    Ok(())
}

/// Writes a file beside its place and moves it there: programs that have loaded the one before go on with it.
fn put(place: &Path, mode: u32, write: impl FnOnce(&Path) -> io::Result<()>) -> io::Result<()> {
    let mut beside = place.as_os_str().to_owned();
    beside.push(format!(".{}", std::process::id()));
    let beside = PathBuf::from(beside);
    let written = write(&beside)
        .and_then(|()| fs::set_permissions(&beside, Permissions::from_mode(mode)))
        .and_then(|()| fs::rename(&beside, place));
    if written.is_err() {
        // What is left over is harmless.
        let _ = fs::remove_file(&beside);
    }
    written
}

fn link(target: &str, place: &Path) -> io::Result<()> {
    match fs::remove_file(place) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => symlink(target, place),
    }
}
