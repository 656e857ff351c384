//! `swanilda run --video`, and the parameters of scripts about videos.

use std::path::Path;
use std::process::Output;

use test_support::process::output_of;

use super::{BALL, Scene, stderr, swanilda};

fn run(scene: &Scene, args: &[&str]) -> Output {
    let mut command = swanilda();
    command
        .arg("run")
        .arg(scene.path())
        .arg("--quiet")
        .args(args)
        .current_dir(scene.folder.path());
    output_of(&mut command)
}

/// The names of the files beside the scene's.
fn files(scene: &Scene) -> Vec<String> {
    let entries = std::fs::read_dir(scene.folder.path()).expect("the folder is there");
    let names = entries.map(|entry| {
        entry
            .expect("it is there")
            .file_name()
            .to_string_lossy()
            .into_owned()
    });
    let mut names: Vec<String> = names.filter(|name| !scene.path().ends_with(name)).collect();
    names.sort();
    names
}

/// The times of the frames of an animated WebP file, milliseconds.
fn durations(path: &Path) -> Vec<u32> {
    let file = std::fs::read(path).expect("it was written");
    assert!(
        file.starts_with(b"RIFF") && file[8..].starts_with(b"WEBPVP8X"),
        "{}",
        path.display()
    );
    let number = |at: usize, bytes: usize| {
        (0..bytes)
            .map(|byte| u32::from(file[at + byte]) << (8 * byte))
            .sum::<u32>()
    };
    let (mut at, mut durations) = (12, Vec::new());
    while at < file.len() {
        let length = number(at + 4, 4) as usize;
        if file[at..].starts_with(b"ANMF") {
            durations.push(number(at + 8 + 12, 3));
        }
        at += 8 + length + length % 2;
    }
    assert_eq!(at, file.len());
    durations
}

#[test]
fn a_video_has_a_picture_for_each_step() {
    let scene = Scene::new(BALL);
    let args = ["--steps", "10", "--video-camera", "Eye", "--video"];
    let output = run(&scene, &[&args[..], &["a.webp"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let times = durations(&scene.folder.path().join("a.webp"));
    // Three more steps follow a request to stop; after the last of them the scene is as it was before.
    assert_eq!(times.iter().sum::<u32>() / 50, 12, "{times:?}");
    assert_eq!(
        run(
            &scene,
            &[&args[..], &["b.webp", "--video-fps", "4"]].concat()
        )
        .status
        .code(),
        Some(0)
    );
    assert!(
        durations(&scene.folder.path().join("b.webp"))
            .iter()
            .all(|time| time % 250 == 0)
    );
    assert_eq!(
        run(
            &scene,
            &[&args[..], &["c-%d.png", "--video-fps", "40"]].concat()
        )
        .status
        .code(),
        Some(0)
    );
    assert_eq!(
        files(&scene)
            .iter()
            .filter(|name| name.starts_with("c-"))
            .count(),
        24
    );
    assert_eq!(
        run(
            &scene,
            &[&args[..], &["d.gif", "--video-size", "20x10"]].concat()
        )
        .status
        .code(),
        Some(0)
    );
    let gif = std::fs::read(scene.folder.path().join("d.gif")).expect("it was written");
    assert_eq!(
        (&gif[..6], &gif[6..10]),
        (&b"GIF89a"[..], &[20, 0, 10, 0][..])
    );
}

#[test]
fn the_same_run_is_the_same_video() {
    let scene = Scene::new(BALL);
    let videos = ["a.webp", "b.webp"].map(|name| {
        let args = ["--steps", "5", "--video-size", "64x48", "--video", name];
        assert_eq!(run(&scene, &args).status.code(), Some(0));
        std::fs::read(scene.folder.path().join(name)).expect("it was written")
    });
    assert!(videos[0] == videos[1]);
}

#[test]
fn a_video_that_cannot_be_written_is_an_error() {
    let scene = Scene::new(BALL);
    for (args, reason) in [
        (
            &["--video", "a.xyz"][..],
            "cannot write a.xyz: unknown kind of video: xyz",
        ),
        (
            &["--video", "a.png"],
            "cannot write a.png: the name of a series has one place for the number",
        ),
        (
            &["--video", "no/such/a.webp"],
            "cannot write no/such/a.webp: ",
        ),
        (
            &["--video", "a.webp", "--video-camera", "/Nobody"],
            "cannot write a.webp: there is no object /Nobody",
        ),
        (
            &["--video", "a.webp", "--video-camera", "Ball"],
            "the object is neither a camera nor a vision sensor",
        ),
        (
            &["--video", "a.webp", "--video-fps", "0"],
            "a number of pictures per second is needed",
        ),
        (&["--video-fps", "5"], "--video <FILE>"),
    ] {
        let output = run(&scene, args);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(
            stderr(&output).contains(reason),
            "{args:?}: {}",
            stderr(&output)
        );
    }
    assert_eq!(files(&scene), [""; 0]);
}

#[test]
fn a_camera_that_goes_ends_the_video() {
    let code = "function sysCall_sensing() if sim.getSimulationTime() > 0.3 then sim.removeObjects({eye}) end end";
    let scene = Scene::new(&format!("{BALL}\n{code}"));
    let output = run(&scene, &["--video", "a.webp", "--video-camera", "Eye"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("cannot write a.webp: the camera is gone"),
        "{}",
        stderr(&output)
    );
    assert!(durations(&scene.folder.path().join("a.webp")).len() > 2);
}

#[cfg(unix)]
#[test]
fn a_killed_run_leaves_the_pictures_of_a_series() {
    let code = "function sysCall_cleanup() end function sysCall_sensing()
        if sim.getSimulationTime() > 0.3 then os.execute('kill -9 $PPID') end end";
    let scene = Scene::new(&format!("{BALL}\n{code}"));
    run(&scene, &["--video", "a-%02d.png", "--video-camera", "Eye"]);
    let names: Vec<String> = files(&scene)
        .into_iter()
        .filter(|name| !name.starts_with('.'))
        .collect();
    assert!(names.len() >= 5 && names[0] == "a-00.png", "{names:?}");
    for name in names {
        let file = std::fs::read(scene.folder.path().join(&name)).expect("it is there");
        assert!(
            file.starts_with(b"\x89PNG") && file.ends_with(b"IEND\xaeB`\x82"),
            "{name}"
        );
    }
}

/// A program of that name is found before any other.
#[cfg(unix)]
#[test]
fn ffmpeg_gets_every_picture() {
    use std::os::unix::fs::PermissionsExt;
    let scene = Scene::new(BALL);
    let program = scene.folder.path().join("ffmpeg");
    let run_with = |text: &str| {
        std::fs::write(&program, text).expect("the folder is writable");
        std::fs::set_permissions(&program, std::fs::Permissions::from_mode(0o755))
            .expect("it is ours");
        let path = format!(
            "{}:{}",
            scene.folder.path().display(),
            std::env::var("PATH").unwrap_or_default()
        );
        let mut command = swanilda();
        command.arg("run").arg(scene.path()).args([
            "--quiet",
            "--steps",
            "10",
            "--video-camera",
            "Eye",
        ]);
        output_of(
            command
                .args(["--video", "a.mp4"])
                .current_dir(scene.folder.path())
                .env("PATH", path),
        )
    };
    let output =
        run_with("#!/bin/sh\nfor file; do :; done\ncat > \"$file\"\necho \"$@\" > arguments\n");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(
        std::fs::read(scene.folder.path().join("a.mp4"))
            .expect("it was written")
            .len(),
        12 * 16 * 12 * 3
    );
    let arguments =
        std::fs::read_to_string(scene.folder.path().join("arguments")).expect("it was written");
    assert!(
        arguments.contains("-video_size 16x12 -framerate 20 "),
        "{arguments}"
    );
    let output = run_with("#!/bin/sh\necho it is Monday >&2\nexit 1\n");
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("cannot write a.mp4: ffmpeg failed: it is Monday"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn scripts_take_videos_by_parameters() {
    let code = "function sysCall_beforeSimulation()
        sim.setStringParam(sim.stringparam_video_filename, 'mine.webp')
        sim.setBoolParam(sim.boolparam_video_recording_triggered, true)
    end
    function sysCall_sensing()
        if sim.getSimulationTime() > 0.4 then sim.setBoolParam(sim.boolparam_video_recording_triggered, false) end
    end";
    let scene = Scene::new(&format!("{BALL}\n{code}"));
    let output = run(&scene, &["--steps", "20"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let times = durations(&scene.folder.path().join("mine.webp"));
    assert!(
        (350..=500).contains(&times.iter().sum::<u32>()),
        "{times:?}"
    );
    std::fs::remove_file(scene.folder.path().join("mine.webp")).expect("it was written");
    let output = run(&scene, &["--steps", "5", "--no-unsafe"]);
    assert!(
        stderr(&output).contains("cannot write the video mine.webp: "),
        "{}",
        stderr(&output)
    );
    assert_eq!(files(&scene), [""; 0]);
}
