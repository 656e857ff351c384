//! All servers of a simulator, and the moments at which their commands are executed (spec: legacy-remote-api 2, 6).

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use super::commands::{self, Asked};
use super::service::{Lifetime, Service};
use scene::numbers;
use scene::{Data, SceneError};
use script::{Host, SimulationState};
use wire::simx::{Answer, Stamp};

/// The servers by port.
#[derive(Default)]
pub(super) struct Services(RefCell<BTreeMap<u16, Rc<Service>>>);

impl Services {
    pub(super) fn add(&self, service: Service) {
        self.0.borrow_mut().insert(service.port(), Rc::new(service));
    }

    pub(super) fn get(&self, port: u16) -> Option<Rc<Service>> {
        self.0.borrow().get(&port).cloned()
    }

    /// Its connection is closed.
    pub(super) fn remove(&self, port: u16) {
        let removed = self.0.borrow_mut().remove(&port);
        // Nothing is borrowed while its thread ends.
        drop(removed);
    }

    fn all(&self) -> Vec<Rc<Service>> {
        self.0.borrow().values().cloned().collect()
    }
}

fn all(host: &Host<'_>) -> Vec<Rc<Service>> {
    host.module_state::<Services>()
        .map_or_else(Vec::new, |services| services.all())
}

/// Between simulations and during a pause, commands are executed in each iteration.
pub(super) fn start_of_iteration(host: &Host<'_>) {
    if !host.clock().state().is_advancing() {
        execute_all(host, &all(host));
    }
}

/// During a simulation, commands are executed before each step. It is held back as long as a client in synchronous mode has not allowed it.
pub(super) fn before_step(host: &Host<'_>) -> bool {
    let services = all(host);
    if services.is_empty() {
        return false;
    }
    execute_all(host, &services);
    let clock = host.clock();
    if clock.stop_is_requested() || clock.state().is_stopping() {
        services
            .iter()
            .for_each(|service| service.end_synchronous_mode());
    }
    update_waiting(host);
    clock.is_waiting_for_trigger()
}

/// Servers of simulation scripts end.
pub(super) fn end_of_simulation(host: &Host<'_>) {
    let Some(services) = host.module_state::<Services>() else {
        return;
    };
    for service in services.all() {
        service.end_synchronous_mode();
        if service.lifetime() == Lifetime::Simulation {
            services.remove(service.port());
        }
    }
    update_waiting(host);
}

/// What `sim.boolparam_waiting_for_trigger` reads.
pub(super) fn update_waiting(host: &Host<'_>) {
    let clock = host.clock();
    let waits = |service: &Rc<Service>| service.is_waiting(clock.steps());
    clock.set_waiting_for_trigger(clock.state().is_advancing() && all(host).iter().any(waits));
}

fn execute_all(host: &Host<'_>, services: &[Rc<Service>]) {
    update_waiting(host);
    for service in services {
        // A command may call a script that runs the loop.
        if !service.is_executing.replace(true) {
            execute(host, service);
            service.is_executing.set(false);
        }
    }
}

/// Executes what is due of one server.
fn execute(host: &Host<'_>, service: &Service) {
    service.acknowledge();
    if service.is_monitored() {
        show_monitor(host, service);
    }
    let stamp = stamp(host);
    let mut batch = service.with_session(|session| session.due(stamp)).flatten();
    let tape = host.options().permissions.tape();
    loop {
        // A replay has no batch: it knows the commands from the capture.
        let next = || {
            let batch = batch.as_mut()?;
            let command = batch.next()?;
            Some(Asked::new(&command, batch.order, batch.is_full()))
        };
        let next = tape.input("a command of the legacy remote API", next);
        let Ok(Some(command)) = next else { break };
        let answer = if command.is_full {
            Answer::failure()
        } else {
            commands::execute(host, service, &command)
        };
        if let Some(batch) = &mut batch {
            batch.answer(answer);
        }
    }
    if let Some(batch) = batch {
        service.with_session(|session| session.complete(batch));
        service.note_executed();
    }
}

fn stamp(host: &Host<'_>) -> Stamp {
    let clock = host.clock();
    let state = clock.state();
    let is_real_time = host.scene().settings().real_time;
    let bits = [
        state != SimulationState::Stopped,
        state == SimulationState::Paused,
        is_real_time,
    ];
    let is_stopped = state == SimulationState::Stopped;
    Stamp {
        system_time: milliseconds(clock.wall_seconds()),
        simulation_time: if is_stopped {
            0
        } else {
            milliseconds(clock.time())
        },
        scene: host.scene_uid() as u16,
        state: bits
            .iter()
            .rev()
            .fold(0, |bits, &bit| bits << 1 | u8::from(bit)),
    }
}

/// Whole milliseconds. Sums of steps may fall short of a whole number by their rounding errors.
fn milliseconds(seconds: f64) -> i32 {
    numbers::low_i32(numbers::truncated(seconds * 1000.0 + 1e-6))
}

/// Prints to the console of a server what happened.
fn show_monitor(host: &Host<'_>, service: &Service) {
    let lines = service.ask(
        "what a monitor of the legacy remote API shows",
        wire::simx::Session::take_lines,
    );
    if lines.is_empty() {
        return;
    }
    // Without a console there is nothing to see, which is no reason to serve nobody.
    let Ok(console) = console(host, service) else {
        return;
    };
    for line in lines {
        let _ = host.call_api(
            "sim.auxiliaryConsolePrint",
            &[Data::Int(console), Data::text(&(line + "\n"))],
        );
    }
}

fn console(host: &Host<'_>, service: &Service) -> script::ApiResult<i64> {
    if let Some(console) = service.console.get() {
        return Ok(console);
    }
    let title = format!("Remote Api monitor on port {}", service.port());
    let opened = host.call_api(
        "sim.auxiliaryConsoleOpen",
        &[Data::text(&title), Data::Int(500), Data::Int(0)],
    )?;
    let Some(&Data::Int(console)) = opened.first() else {
        return Err(SceneError::InvalidArgument.into());
    };
    service.console.set(Some(console));
    Ok(console)
}
