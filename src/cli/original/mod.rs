//! `swanilda coppeliasim`: the start with the options of CoppeliaSim's executable, for programs that start that one.

use std::net::{Ipv4Addr, TcpListener};

use clap::Parser;
use scene::Data;
use script::literal;

use super::remote::LEGACY_PORT;
use super::{Cli, Command, Outcome, serve};

/// The add-on that starts and ends the simulation.
const STARTER: &str = include_str!("starter.lua");

/// Start with the options of CoppeliaSim's executable
#[derive(clap::Args)]
#[command(disable_help_flag = true, disable_version_flag = true)]
pub(super) struct Args {
    /// Print help
    #[arg(long, action = clap::ArgAction::Help)]
    help: Option<bool>,
    /// -h and -H: without windows, as always; -sMS: start the simulation, and stop it after so many milliseconds; -q: end the program
    /// with the first simulation; -gTEXT: argument for scripts; -GNAME=VALUE: named parameter; -aFILE, -bFILE: additional add-ons;
    /// -cCODE: code for the sandbox; -vLEVEL: what is logged; a scene or model
    #[arg(
        value_name = "OPTION|FILE",
        allow_hyphen_values = true,
        trailing_var_arg = true
    )]
    args: Vec<String>,
}

/// What the options say.
#[derive(Debug, Default, PartialEq)]
struct Start {
    /// Those of `swanilda serve`.
    serve: Vec<String>,
    /// The simulation starts at once.
    starts: bool,
    /// When it is stopped, milliseconds of simulated time.
    time: Option<u64>,
    quits: bool,
    /// For scripts.
    arguments: Vec<String>,
    /// For the sandbox.
    code: String,
}

pub(super) fn start(args: &Args) -> Outcome {
    let start = Start::of(&args.args)?;
    let legacy = TcpListener::bind((Ipv4Addr::LOCALHOST, LEGACY_PORT)).is_ok();
    let legacy = legacy.then(|| "--legacy-remote-api".to_owned());
    let command = ["swanilda", "serve"].map(str::to_owned).into_iter();
    let command = command.chain(start.serve.iter().cloned()).chain(legacy);
    let parsed = Cli::try_parse_from(command).map_err(|error| error.to_string())?;
    let Command::Serve(mut args) = parsed.command else {
        return Err("the start has become another command".to_owned());
    };
    args.setup.starter = Some(start.add_on());
    serve::serve(&args)
}

impl Start {
    fn of(args: &[String]) -> Result<Self, String> {
        let mut start = Self::default();
        args.iter().try_for_each(|arg| start.take(arg))?;
        Ok(start)
    }

    fn take(&mut self, arg: &str) -> Result<(), String> {
        let Some(option) = arg.strip_prefix('-').filter(|option| !option.is_empty()) else {
            self.serve.push(arg.to_owned());
            return Ok(());
        };
        let letter = option.chars().next().unwrap_or_default();
        let value = &option[letter.len_utf8()..];
        match letter {
            'h' | 'H' | 'w' => {}
            's' => self.starts_for(value)?,
            'q' => self.quits = true,
            'g' => self.arguments.push(value.to_owned()),
            'G' => self.passes("-D", value),
            'a' | 'b' => self.passes("--addon", value),
            'c' => self.code = value.to_owned(),
            'v' => self.passes("--verbosity", value),
            _ => return Err(unknown(arg)),
        }
        Ok(())
    }

    fn starts_for(&mut self, value: &str) -> Result<(), String> {
        self.starts = true;
        if !value.is_empty() {
            let time = value
                .parse()
                .map_err(|_| format!("-s takes milliseconds, not '{value}'"))?;
            self.time = Some(time);
        }
        Ok(())
    }

    fn passes(&mut self, option: &str, value: &str) {
        self.serve.extend([option.to_owned(), value.to_owned()]);
    }

    /// The add-on that does what the options say when the scene is there.
    fn add_on(&self) -> String {
        let arguments: Vec<String> = self
            .arguments
            .iter()
            .map(|text| literal(&Data::text(text)))
            .collect();
        format!(
            "local options = {{starts = {}, time = {}, quits = {}, arguments = {{{}}}, code = {}}}\n{STARTER}",
            self.starts,
            self.time
                .map_or("math.huge".to_owned(), |time| format!("{time} / 1000")),
            self.quits,
            arguments.join(", "),
            literal(&Data::text(&self.code)),
        )
    }
}

fn unknown(arg: &str) -> String {
    format!(
        "'{arg}' is no option of CoppeliaSim's executable that is known here: `swanilda serve --help` lists Swanilda's own, \
         `swanilda coppeliasim --help` those that are accepted"
    )
}

#[cfg(test)]
mod tests {
    use super::Start;

    fn start(args: &[&str]) -> Result<Start, String> {
        Start::of(&args.iter().map(|&arg| arg.to_owned()).collect::<Vec<_>>())
    }

    #[test]
    fn options_have_their_values_attached() {
        let parsed = start(&[
            "-h",
            "-s5000",
            "-q",
            "-Ga.b=1",
            "-gone",
            "-gtwo",
            "-atool.lua",
            "scene.ttt",
        ]);
        let expected = Start {
            serve: ["-D", "a.b=1", "--addon", "tool.lua", "scene.ttt"]
                .map(str::to_owned)
                .to_vec(),
            starts: true,
            time: Some(5000),
            quits: true,
            arguments: ["one", "two"].map(str::to_owned).to_vec(),
            code: String::new(),
        };
        assert_eq!(parsed, Ok(expected));
        let endless = start(&["-s", "scene.ttt"]).expect("no time is no mistake");
        assert_eq!((endless.starts, endless.time), (true, None));
    }

    #[test]
    fn what_is_unknown_is_named() {
        for (arg, part) in [("-x", "'-x'"), ("-sfoo", "'foo'"), ("--serve", "'--serve'")] {
            let error = start(&[arg]).expect_err("it is no option");
            assert!(error.contains(part), "{error}");
        }
    }
}
