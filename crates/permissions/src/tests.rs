//! Paths and places, allowed and not.

use std::fs;

use super::*;

fn text<T>(result: Result<T, Denied>) -> String {
    result
        .err()
        .map(|denied| denied.to_string())
        .unwrap_or_default()
}

#[test]
fn sets() {
    assert!(Permissions::all().is_all() && Permissions::default().is_all());
    assert!(!Permissions::none().is_all() && !Permissions::strict().is_all());
    let everything = Permissions::none()
        .allow_read_everywhere()
        .allow_write_everywhere()
        .allow_net_everywhere();
    assert!(!everything.is_all() && everything.clone().allow_run().allow_native().is_all());
    assert_eq!(everything.check_environment(), Ok(()));
    assert_eq!(everything.check_redirect("a link"), Ok(()));
}

#[test]
fn refusals_name_the_option() {
    let none = Permissions::none();
    let path = Path::new("/nowhere/file");
    assert_eq!(
        text(none.check_read(path)),
        "reading '/nowhere/file' is not allowed: run with --allow-read=/nowhere"
    );
    assert_eq!(
        text(none.check_write(path)),
        "writing '/nowhere/file' is not allowed: run with --allow-write=/nowhere"
    );
    assert_eq!(
        text(none.check_inspect(path)),
        "reading '/nowhere/file' is not allowed: run with --allow-read=/nowhere/file"
    );
    assert_eq!(
        text(none.check_run("ls -l")),
        "running 'ls -l' is not allowed: run with --allow-run"
    );
    assert_eq!(
        text(none.check_native("bytecode")),
        "bytecode is not allowed: run with --allow-native"
    );
    assert_eq!(
        text(none.check_net("::1", Some(80))),
        "the network at '[::1]:80' is not allowed: run with --allow-net=[::1]:80"
    );
    assert_eq!(
        std::io::Error::from(none.check_read(path).unwrap_err()).kind(),
        std::io::ErrorKind::PermissionDenied
    );
}

#[test]
fn the_folder_of_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.lua");
    assert!(Permissions::strict().check_read(&file).is_err());
    assert_eq!(
        Permissions::strict()
            .of_scene(folder.path())
            .check_read(&file),
        Ok(())
    );
    assert!(
        Permissions::strict()
            .of_scene(folder.path())
            .check_write(&file)
            .is_err()
    );
    assert!(
        Permissions::none()
            .of_scene(folder.path())
            .check_read(&file)
            .is_err()
    );
}

#[test]
fn dots_do_not_lead_out() {
    let above = tempfile::tempdir().unwrap();
    let folder = above.path().join("in");
    fs::create_dir_all(folder.join("deep")).unwrap();
    let allowed = Permissions::none().allow_read(&folder);
    for inside in [
        "x",
        "deep/../x",
        "missing/x",
        "./x",
        "../in/x",
        "missing/../x",
        "",
    ] {
        assert_eq!(allowed.check_read(&folder.join(inside)), Ok(()), "{inside}");
    }
    for outside in ["../x", "deep/../../x", "missing/../../x", "..", "../in2/x"] {
        assert!(
            allowed.check_read(&folder.join(outside)).is_err(),
            "{outside}"
        );
        assert!(
            allowed.check_inspect_link(&folder.join(outside)).is_err(),
            "{outside}"
        );
    }
    let refusal = text(allowed.check_read(&folder.join("deep/../../x/y")));
    assert!(
        refusal.ends_with(&format!(
            "--allow-read={}",
            above.path().join("x").display()
        )),
        "{refusal}"
    );
}

#[cfg(unix)]
#[test]
fn links_do_not_lead_out() {
    use std::os::unix::fs::symlink;
    let above = tempfile::tempdir().unwrap();
    let (folder, other) = (above.path().join("in"), above.path().join("out"));
    fs::create_dir_all(&folder).unwrap();
    fs::create_dir_all(&other).unwrap();
    symlink(&other, folder.join("folder")).unwrap();
    symlink("../out/not there yet", folder.join("dangling")).unwrap();
    symlink("inner", folder.join("inner link")).unwrap();
    symlink("round", folder.join("round")).unwrap();
    let allowed = Permissions::none().allow_write(&folder).allow_read(&folder);
    for outside in ["folder", "folder/x", "dangling", "folder/../x", "round"] {
        assert!(
            allowed.check_write(&folder.join(outside)).is_err(),
            "{outside}"
        );
    }
    assert_eq!(allowed.check_write(&folder.join("inner link")), Ok(()));
    let link = folder.join("dangling");
    assert!(
        text(allowed.check_write(&link)).ends_with(&format!("--allow-write={}", link.display())),
        "of the link"
    );
    // The link itself lies in the folder.
    assert_eq!(allowed.check_write_entry(&folder.join("folder")), Ok(()));
    for through in ["folder/", "folder/.", "folder/..", "folder/x"] {
        assert!(
            allowed.check_write_entry(&folder.join(through)).is_err(),
            "{through}"
        );
    }
    assert!(
        allowed
            .check_rename(&other.join("x"), &folder.join("x"))
            .is_err()
    );
    // A folder that is named by a link is the one it leads to.
    let by_link = Permissions::none().allow_read(folder.join("folder"));
    assert_eq!(by_link.check_read(&other.join("x")), Ok(()));
}

#[test]
fn hosts_and_ports() {
    let rule = |text: &str| text.parse::<HostRule>();
    let allowed = |rules: &[&str]| {
        rules.iter().fold(Permissions::none(), |allowed, text| {
            allowed.allow_net(rule(text).expect("well-formed"))
        })
    };
    let one = allowed(&["127.0.0.1:80", "Example.org", "[::1]:9"]);
    for (host, port) in [
        ("127.0.0.1", 80),
        ("example.ORG", 1),
        ("example.org.", 2),
        ("::1", 9),
        ("0:0::1", 9),
    ] {
        assert_eq!(one.check_net(host, Some(port)), Ok(()), "{host}:{port}");
    }
    for (host, port) in [
        ("127.0.0.1", 81),
        ("localhost", 80),
        ("a.example.org", 1),
        ("::1", 8),
        ("0.0.0.0", 80),
    ] {
        assert!(one.check_net(host, Some(port)).is_err(), "{host}:{port}");
    }
    assert_eq!(one.check_net("example.org", None), Ok(()));
    assert_eq!(one.check_net("127.0.0.1", None), Ok(()), "a lookup");
    assert!(one.check_net("127.0.0.2", None).is_err());
    assert!(one.check_net_everywhere("all").is_err());
    assert_eq!(rule("::1"), Ok(HostRule::new("::1", None)));
    assert_eq!(rule("[::1]"), Ok(HostRule::new("::1", None)));
    for wrong in ["", ":80", "host:", "host:port", "host:99999", "a:b:1"] {
        assert!(rule(wrong).is_err(), "{wrong}");
    }
}

#[test]
fn each_permission_opens_what_it_names_and_nothing_else() {
    let (file, none) = (Path::new("/nowhere/file"), Permissions::none);
    let opened = |allowed: &Permissions| {
        [
            allowed.check_read(file).is_ok(),
            allowed.check_environment().is_ok(),
            allowed.check_write(file).is_ok(),
            allowed.check_net_everywhere("all").is_ok(),
            allowed.can_run() && allowed.check_run("ls").is_ok(),
            allowed.can_load_native() && allowed.check_native("a library").is_ok(),
        ]
    };
    let only = |places: &[usize]| std::array::from_fn(|place| places.contains(&place));
    assert_eq!(opened(&none()), only(&[]));
    assert_eq!(opened(&none().allow_read_everywhere()), only(&[0, 1]));
    assert_eq!(opened(&none().allow_read("/nowhere")), only(&[0]));
    assert_eq!(opened(&none().allow_write_everywhere()), only(&[2]));
    assert_eq!(opened(&none().allow_write("/nowhere")), only(&[2]));
    assert_eq!(opened(&none().allow_net_everywhere()), only(&[3]));
    assert_eq!(opened(&none().allow_run()), only(&[4]));
    assert_eq!(opened(&none().allow_native()), only(&[5]));
    assert_eq!(opened(&Permissions::all()), only(&[0, 1, 2, 3, 4, 5]));
    assert!(!none().can_run() && !none().can_load_native());
}

#[test]
fn only_who_reads_and_writes_everything_changes_where_paths_lead() {
    let read = Permissions::none().allow_read_everywhere();
    let write = Permissions::none().allow_write_everywhere();
    assert!(read.check_redirect("a link").is_err() && write.check_redirect("a link").is_err());
    assert_eq!(
        read.allow_write_everywhere().check_redirect("a link"),
        Ok(())
    );
}

#[test]
fn a_device_has_to_be_readable_and_writable() {
    let device = Path::new("/nowhere/device");
    let (read, write) = (
        Permissions::none().allow_read("/nowhere"),
        Permissions::none().allow_write("/nowhere"),
    );
    assert_eq!(
        text(write.check_device(device)),
        "reading '/nowhere/device' is not allowed: run with --allow-read=/nowhere/device"
    );
    assert_eq!(
        text(read.check_device(device)),
        "writing '/nowhere/device' is not allowed: run with --allow-write=/nowhere/device"
    );
    assert_eq!(read.allow_write("/nowhere").check_device(device), Ok(()));
}

#[test]
fn a_renamed_file_is_read_and_written_at_both_places() {
    let (old, new) = (Path::new("/nowhere/old"), Path::new("/elsewhere/new"));
    let whole = |without: usize| {
        let grants: [fn(Permissions) -> Permissions; 3] = [
            |allowed| allowed.allow_read("/nowhere"),
            |allowed| allowed.allow_write("/nowhere"),
            |allowed| allowed.allow_write("/elsewhere"),
        ];
        let granted = grants.iter().enumerate().filter(|(at, _)| *at != without);
        granted.fold(Permissions::none(), |allowed, (_, grant)| grant(allowed))
    };
    assert_eq!(whole(3).check_rename(old, new), Ok(()));
    for (without, doing) in ["reading", "writing", "writing"].iter().enumerate() {
        assert!(text(whole(without).check_rename(old, new)).starts_with(doing));
    }
}

#[test]
fn files_are_read_where_that_is_allowed() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "text").unwrap();
    let allowed = Permissions::none().allow_read(folder.path());
    assert_eq!(allowed.read_file(&file).unwrap(), b"text");
    let refused = Permissions::none().read_file(&file).unwrap_err();
    assert_eq!(refused.kind(), std::io::ErrorKind::PermissionDenied);
}

/// As many as Linux follows: 40.
#[cfg(unix)]
#[test]
fn long_chains_of_links_are_followed_as_the_system_does() {
    let folder = tempfile::tempdir().unwrap();
    let name = |number: usize| folder.path().join(number.to_string());
    fs::write(name(0), "").unwrap();
    for number in 1..=41 {
        std::os::unix::fs::symlink(name(number - 1), name(number)).unwrap();
    }
    let allowed = Permissions::none().allow_read(folder.path());
    assert!(fs::read(name(40)).is_ok() && fs::read(name(41)).is_err());
    assert_eq!(allowed.check_read(&name(40)), Ok(()));
    assert!(allowed.check_read(&name(41)).is_err());
}

#[cfg(unix)]
#[test]
fn a_name_that_ends_in_dots_or_a_separator_means_what_a_link_leads_to() {
    let above = tempfile::tempdir().unwrap();
    let (folder, other) = (above.path().join("in"), above.path().join("out"));
    fs::create_dir_all(&folder).unwrap();
    fs::create_dir_all(&other).unwrap();
    std::os::unix::fs::symlink(&other, folder.join("link")).unwrap();
    let allowed = Permissions::none().allow_read(&folder);
    assert_eq!(allowed.check_inspect_link(&folder.join("link")), Ok(()));
    for name in ["link/", "link/.", "link/x"] {
        assert!(
            allowed.check_inspect_link(&folder.join(name)).is_err(),
            "{name}"
        );
    }
    // Dots at the end of a name belong to it.
    std::os::unix::fs::symlink(&other, folder.join("link.")).unwrap();
    assert_eq!(allowed.check_inspect_link(&folder.join("link.")), Ok(()));
}

#[test]
fn names_of_c_end_at_a_nul() {
    assert_eq!(c_path(b"/a/b\0c"), Path::new("/a/b"));
    assert_eq!(c_path(b"/a/b"), Path::new("/a/b"));
    assert_eq!(c_path(b""), Path::new(""));
}

#[test]
fn everything_is_all_of_it() {
    let grants: [fn(Permissions) -> Permissions; 5] = [
        Permissions::allow_read_everywhere,
        Permissions::allow_write_everywhere,
        Permissions::allow_net_everywhere,
        Permissions::allow_run,
        Permissions::allow_native,
    ];
    let without = |missing: usize| {
        let granted = grants.iter().enumerate().filter(|(at, _)| *at != missing);
        granted.fold(Permissions::none(), |allowed, (_, grant)| grant(allowed))
    };
    assert!(without(grants.len()).is_all());
    assert!((0..grants.len()).all(|missing| !without(missing).is_all()));
}

#[test]
fn a_replay_looks_at_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let (path, capture) = (folder.path().join("a.txt"), folder.path().join("run.swc"));
    let ask = |permissions: &Permissions| {
        (
            permissions.read_file(&path).map_err(|error| error.kind()),
            permissions.exists(&path),
            permissions.is_file(&path),
            permissions.is_dir(folder.path()),
            permissions.absolute(Path::new("x")).unwrap(),
            permissions.check_read(Path::new("/elsewhere")).is_ok(),
        )
    };
    std::fs::write(&path, "text").unwrap();
    let permissions = Permissions::none().allow_read(folder.path());
    let tape = capture::Tape::capturing(&capture, &capture::Header::default()).unwrap();
    let first = ask(&permissions.clone().on_tape(&tape));
    assert_eq!(first, ask(&permissions), "a capture changes nothing");
    tape.finish().unwrap();
    std::fs::remove_file(&path).unwrap();
    let (tape, _) = capture::Tape::replaying(&capture).unwrap();
    // Even the permissions come from the capture.
    assert_eq!(ask(&permissions.clone().on_tape(&tape)), first);
    let verdict = tape.finish().unwrap();
    assert_eq!(verdict, Some(capture::Verdict::Same { steps: 0 }));
    assert_ne!(ask(&permissions), first);
}
