//! `swanilda library`: a folder that programs take for an installation of CoppeliaSim.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use c_interface::folder::{Folder, Release, SIMULATOR};

use super::{Outcome, say};

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

/// As it is written on the command line.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum Version {
    /// Numbers in single precision: PyRep, RLBench.
    #[value(name = "4.1")]
    V41,
    /// Numbers in double precision: CoppeliaSim's own Python package.
    #[value(name = "4.10")]
    V410,
}

impl From<Version> for Release {
    fn from(version: Version) -> Self {
        match version {
            Version::V41 => Self::V41,
            Version::V410 => Self::V410,
        }
    }
}

pub(super) fn library(args: &Args) -> Outcome {
    let release = Release::from(args.release);
    if !release.is_supported() {
        return Err("the library is there on Linux only".to_owned());
    }
    let program =
        std::env::current_exe().map_err(|error| format!("where is this program? {error}"))?;
    let simulator = match &args.simulator {
        Some(file) => file.clone(),
        None => found(&program)?,
    };
    let folder = Folder {
        release,
        simulator: &simulator,
        command: (!args.without_command).then_some(&program),
    };
    folder
        .write(&args.folder)
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
