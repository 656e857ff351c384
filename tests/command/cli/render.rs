//! `swanilda render`.

use std::path::Path;
use std::process::Output;

use test_support::process::output_of;

use super::{BALL, Scene, stderr, stdout, swanilda};

fn render(scene: &Scene, args: &[&str]) -> Output {
    let mut command = swanilda();
    command
        .arg("render")
        .arg(scene.path())
        .args(args)
        .current_dir(scene.folder.path());
    output_of(&mut command)
}

/// Width, height, bits per channel, and colour type of a PNG file.
fn header(path: &Path) -> (u32, u32, u8, u8) {
    let file = std::fs::read(path).expect("it was written");
    assert!(file.starts_with(b"\x89PNG"), "{}", path.display());
    let number =
        |at: usize| u32::from_be_bytes([file[at], file[at + 1], file[at + 2], file[at + 3]]);
    (number(16), number(20), file[24], file[25])
}

#[test]
fn a_picture_is_written() {
    let scene = Scene::new(BALL);
    let file = |name: &str| scene.folder.path().join(name);
    assert_eq!(render(&scene, &["--quiet"]).status.code(), Some(0));
    assert_eq!(header(&file("picture.png")), (640, 480, 8, 2));
    assert_eq!(
        render(&scene, &["--camera", "/Eye", "-o", "eye.png"])
            .status
            .code(),
        Some(0)
    );
    assert_eq!(header(&file("eye.png")), (16, 12, 8, 2));
    assert_eq!(
        render(
            &scene,
            &["--camera", "Eye", "--size", "30x20", "-o", "large.png"]
        )
        .status
        .code(),
        Some(0)
    );
    assert_eq!(header(&file("large.png")), (30, 20, 8, 2));
    assert_eq!(
        render(&scene, &["--empty", "--size", "30x20", "-o", "fitted.jpg"])
            .status
            .code(),
        Some(0)
    );
    assert!(
        std::fs::read(file("fitted.jpg"))
            .expect("it was written")
            .starts_with(b"\xff\xd8")
    );
}

#[test]
fn depths_are_millimetres_and_objects_have_colours() {
    let scene = Scene::new(BALL);
    let depth = scene.folder.path().join("depth.png");
    let args = [
        "--camera",
        "Eye",
        "--depth",
        "--time",
        "1",
        "-o",
        "depth.png",
        "--quiet",
    ];
    assert_eq!(render(&scene, &args).status.code(), Some(0));
    assert_eq!(header(&depth), (16, 12, 16, 0));
    let output = render(
        &scene,
        &[
            "--camera",
            "Eye",
            "--segmentation",
            "-o",
            "objects.png",
            "--quiet",
        ],
    );
    assert_eq!(output.status.code(), Some(0));
    let text = stdout(&output);
    assert!(
        text.starts_with('#') && text.ends_with(" /Ball\n") && text.lines().count() == 1,
        "{text}"
    );
    assert_eq!(
        header(&scene.folder.path().join("objects.png")),
        (16, 12, 8, 2)
    );
}

#[test]
fn what_cannot_be_rendered_is_an_error() {
    let scene = Scene::new(BALL);
    for (args, reason) in [
        (
            &["--camera", "/Nobody"][..],
            "there is no object /Nobody in ",
        ),
        (
            &["--camera", "Ball"],
            "Ball is neither a camera nor a vision sensor",
        ),
        (&["--size", "640"], "width and height are needed"),
        (&["--size", "0x5"], "width and height are needed"),
        (
            &["-o", "picture.xyz"],
            "cannot write picture.xyz: unknown kind of image: xyz",
        ),
        (
            &["--depth", "-o", "depth.jpg"],
            "cannot write depth.jpg: unknown kind of image: jpg for depths",
        ),
        (
            &["-o", "no/such/folder.png"],
            "cannot write no/such/folder.png: ",
        ),
        (&["--depth", "--segmentation"], "cannot be used with"),
    ] {
        let output = render(&scene, args);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(
            stderr(&output).contains(reason),
            "{args:?}: {}",
            stderr(&output)
        );
    }
    let failing = Scene::new("error('no')");
    let output = render(&failing, &["--quiet"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(header(&failing.folder.path().join("picture.png")).0, 640);
}
