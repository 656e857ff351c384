//! `swanilda view` as a process, with its address.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::sync::Mutex;
use std::sync::mpsc::{Receiver, channel};

use test_support::process::{LIMIT, wait_within};

/// A served scene. The process ends with it.
pub struct Served {
    child: Child,
    pub port: u16,
    pub token: String,
    /// Lines that were printed after the address of the page.
    lines: Mutex<Receiver<String>>,
    _folder: tempfile::TempDir,
}

impl Served {
    /// Serves a script with `swanilda view`.
    pub fn start(script: &str, options: &[&str]) -> Self {
        Self::start_command("view", script, &[&["--no-open"], options].concat())
    }

    /// The same with another command that has a viewer.
    pub fn start_command(command: &str, script: &str, options: &[&str]) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("scene.lua"), script).expect("the scene is written");
        Self::start_file(command, folder, "scene.lua", options)
    }

    /// The same with a file of a folder, which is removed at the end.
    pub fn start_file(
        command: &str,
        folder: tempfile::TempDir,
        file: &str,
        options: &[&str],
    ) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_swanilda"))
            .arg(command)
            .arg(folder.path().join(file))
            .args(options)
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts");
        let mut lines = BufReader::new(child.stdout.take().expect("it is piped")).lines();
        let url = loop {
            let line = lines
                .next()
                .expect("the address is printed")
                .expect("it is text");
            if let Some(url) = line.strip_prefix("Viewer at http://127.0.0.1:") {
                break url.to_owned();
            }
        };
        // Somebody must read on, or a full pipe stops the scripts.
        let (sender, received) = channel();
        std::thread::spawn(move || {
            lines
                .map_while(Result::ok)
                .for_each(|line| drop(sender.send(line)));
        });
        let (port, token) = url
            .trim_end_matches('/')
            .split_once('/')
            .expect("a port and a secret");
        Self {
            child,
            port: port.parse().expect("a port"),
            token: token.to_owned(),
            lines: Mutex::new(received),
            _folder: folder,
        }
    }

    /// The port of another server, whose address is printed after these words.
    pub fn address_of(&self, words: &str) -> u16 {
        let lines = self.lines.lock().expect("nobody panics with it");
        loop {
            let line = lines.recv_timeout(LIMIT).expect("the address is printed");
            if let Some(address) = line.strip_prefix(words) {
                return address
                    .rsplit(':')
                    .next()
                    .expect("a port")
                    .parse()
                    .expect("a port");
            }
        }
    }

    pub fn interrupt(&mut self) {
        let kill = Command::new("kill")
            .args(["-INT", &self.child.id().to_string()])
            .status();
        assert!(kill.expect("there is kill").success());
    }

    /// Waits for the end; its exit code.
    pub fn wait(&mut self) -> Option<i32> {
        wait_within(&mut self.child, LIMIT).expect("it ends").code()
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
