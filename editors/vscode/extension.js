// Starts `swanilda debug` for the debugger of Visual Studio Code, which speaks its protocol; and lets the Lua language server know `sim`.

const childProcess = require('node:child_process');
const vscode = require('vscode');

function command() {
    return vscode.workspace.getConfiguration('swanilda').get('path') || 'swanilda';
}

const adapters = {
    createDebugAdapterDescriptor(session) {
        const { request, port, host } = session.configuration;
        if (request === 'attach' || port) return new vscode.DebugAdapterServer(port, host || '127.0.0.1');
        return new vscode.DebugAdapterExecutable(command(), ['debug']);
    },
};

const configurations = {
    // Without a launch.json the open file is run.
    resolveDebugConfiguration(folder, configuration) {
        const editor = vscode.window.activeTextEditor;
        if (configuration.type || !editor) return configuration;
        return { type: 'swanilda', request: 'launch', name: 'Debug this scene', program: editor.document.uri.fsPath };
    },
};

// `swanilda init` writes the stubs, and the settings that name them.
function writeStubs() {
    const folder = vscode.workspace.workspaceFolders?.[0]?.uri.fsPath;
    if (!folder) return vscode.window.showErrorMessage('Open a folder first.');
    childProcess.execFile(command(), ['init', '--force', folder], (error, output, reason) => {
        if (error) vscode.window.showErrorMessage(`swanilda init: ${reason || error.message}`);
        else vscode.window.showInformationMessage(output.trim());
    });
}

exports.activate = (context) => {
    context.subscriptions.push(
        vscode.debug.registerDebugAdapterDescriptorFactory('swanilda', adapters),
        vscode.debug.registerDebugConfigurationProvider('swanilda', configurations),
        vscode.commands.registerCommand('swanilda.writeStubs', writeStubs),
    );
};
