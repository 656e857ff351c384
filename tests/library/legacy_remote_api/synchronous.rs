//! Control of the simulation, and the synchronous mode.

use std::time::Duration;

use test_support::process::wait_until;

use super::simx::{BLOCKING, Client, Server, command, ints, read_ints};

const SCENE: &str = "sim = require 'sim'";

const START: i32 = 0;
const PAUSE: i32 = 1;
const STOP: i32 = 2;

fn control(client: &mut Client, what: i32) {
    client.get(0x1007, &ints(&[what]), &[]);
}

/// What `simxGetPingTime` does; returns the time of the simulation in milliseconds.
fn ping(client: &mut Client) -> i32 {
    client
        .call(command(0x1021, BLOCKING, &ints(&[1]), &[]))
        .time
}

fn trigger_fails(client: &mut Client) -> bool {
    client.fails(0x0003, &[], &[])
}

fn waits(client: &mut Client) -> bool {
    read_ints(&client.get(0x101f, &ints(&[45]), &[])) == [1]
}

/// Until the state of the simulation is that: bit 0 not stopped, bit 1 paused.
fn wait_for_state(client: &mut Client, state: u8) {
    let asked = command(0x1021, BLOCKING, &ints(&[1]), &[]);
    wait_until("the state comes", || {
        client.exchange(std::slice::from_ref(&asked)).state == state
    });
}

fn wait_until_steps_run_freely(client: &mut Client) {
    let first = ping(client);
    wait_until("the simulation goes on", || ping(client) >= first + 100);
}

#[test]
fn each_trigger_makes_one_step() {
    let server = Server::start(SCENE);
    let mut client = server.connect();
    client.get(0x0001, &[], &[]);
    control(&mut client, START);
    assert_eq!(ping(&mut client), 0);
    for step in 1..=5 {
        assert!(waits(&mut client));
        client.get(0x0003, &[], &[]);
        assert_eq!(ping(&mut client), 50 * step);
        std::thread::sleep(Duration::from_millis(10));
        assert_eq!(
            ping(&mut client),
            50 * step,
            "nothing happens without a trigger"
        );
    }
}

#[test]
fn a_trigger_needs_a_running_simulation_and_the_mode() {
    let server = Server::start(SCENE);
    let mut client = server.connect();
    assert!(trigger_fails(&mut client), "stopped");
    control(&mut client, START);
    assert!(trigger_fails(&mut client), "not enabled");
    client.get(0x0001, &[], &[]);
    client.get(0x0003, &[], &[]);
    client.get(0x0002, &[], &[]);
    control(&mut client, PAUSE);
    wait_for_state(&mut client, 3);
    client.get(0x0001, &[], &[]);
    assert!(trigger_fails(&mut client), "paused");
}

#[test]
fn a_stop_ends_the_mode() {
    let server = Server::start(SCENE);
    let mut client = server.connect();
    client.get(0x0001, &[], &[]);
    control(&mut client, START);
    client.get(0x0003, &[], &[]);
    control(&mut client, STOP);
    wait_for_state(&mut client, 0);
    control(&mut client, START);
    wait_until_steps_run_freely(&mut client);
}

#[test]
fn a_client_that_vanishes_frees_the_simulation() {
    let server = Server::start(SCENE);
    let mut client = server.connect();
    client.get(0x0001, &[], &[]);
    control(&mut client, START);
    assert!(waits(&mut client));
    drop(client);
    let mut next = server.connect();
    wait_until_steps_run_freely(&mut next);
    assert!(!waits(&mut next));
}

#[test]
fn streams_go_on_over_stop_and_start() {
    let server = Server::start(SCENE);
    let mut client = server.connect();
    let floor = client.handle("/Floor");
    let key = [floor, (-1_i32).to_le_bytes()].concat();
    client.exchange(&[command(0x200e, 2, &key, &[])]);
    control(&mut client, START);
    control(&mut client, STOP);
    wait_for_state(&mut client, 0);
    wait_until("the stream goes on", || {
        client
            .exchange(&[])
            .commands
            .iter()
            .any(|answer| answer.id == 0x200e)
    });
}

#[test]
fn starting_twice_is_no_failure() {
    let server = Server::start(SCENE);
    let mut client = server.connect();
    for what in [STOP, START, START, STOP, STOP] {
        control(&mut client, what);
    }
    wait_for_state(&mut client, 0);
}
