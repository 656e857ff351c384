//! `swanilda unpack` and `swanilda pack`: scenes as folders for version control, and back.

use std::path::PathBuf;
use std::process::ExitCode;

use super::{files, refuse};
use crate::format::scene_file::write_whole;
use crate::format::scene_folder;

/// Write a scene or model as a folder: a tree in JSON, scripts as Lua files, meshes as OBJ files
#[derive(clap::Args)]
pub(super) struct UnpackArgs {
    /// A .ttt or .ttm file
    file: PathBuf,
    /// A new or empty folder, or one that was unpacked before
    folder: PathBuf,
}

/// Write the scene or model that a folder says
#[derive(clap::Args)]
pub(super) struct PackArgs {
    /// A folder made by unpack
    folder: PathBuf,
    /// A .ttt or .ttm file
    file: PathBuf,
}

pub(super) fn unpack(args: &UnpackArgs) -> ExitCode {
    done(files::file(&args.file).and_then(|file| scene_folder::unpack(&file, &args.folder)))
}

pub(super) fn pack(args: &PackArgs) -> ExitCode {
    let written = files::file(&args.folder).and_then(|file| {
        write_whole(&args.file, &file.write()).map_err(|error| format!("cannot write {}: {error}", args.file.display()))
    });
    done(written)
}

fn done(result: Result<(), String>) -> ExitCode {
    result.map_or_else(|reason| refuse(&reason), |()| ExitCode::SUCCESS)
}
