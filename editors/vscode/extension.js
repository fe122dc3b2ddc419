// Starts `cnctrans lsp` for the four languages and gives its commands a place in the editor.
const vscode = require("vscode");
const { LanguageClient, TransportKind } = require("vscode-languageclient/node");
const { languages, settingsFrom, translationText } = require("./shared");

let client;

async function askServer(command, ...args) {
  return client.sendRequest("workspace/executeCommand", { command, arguments: args });
}

async function translateTo() {
  const editor = vscode.window.activeTextEditor;
  if (!editor) return;
  const others = languages.filter((l) => l.id !== editor.document.languageId);
  const to = await vscode.window.showQuickPick(others.map((l) => ({ label: l.title, id: l.id })), { placeHolder: "Translate to" });
  if (!to) return;
  const done = await askServer("cnctrans.translate", editor.document.uri.toString(), to.id);
  if (done.refused || done.outputs.length === 0) {
    const document = await vscode.workspace.openTextDocument({ language: "markdown", content: translationText(done) });
    await vscode.window.showTextDocument(document, vscode.ViewColumn.Beside);
    return;
  }
  for (const output of done.outputs) {
    const document = await vscode.workspace.openTextDocument({ language: to.id, content: output.text });
    await vscode.window.showTextDocument(document, { viewColumn: vscode.ViewColumn.Beside, preview: false });
  }
  const say = done.held_back ? vscode.window.showErrorMessage : vscode.window.showInformationMessage;
  say(done.held_back ? "Not to be cut with: " + done.verdict : done.verdict);
}

async function showToolPath() {
  const editor = vscode.window.activeTextEditor;
  if (!editor) return;
  const { html } = await askServer("cnctrans.toolPath", editor.document.uri.toString());
  const panel = vscode.window.createWebviewPanel("cnctrans.toolPath", "Tool path", vscode.ViewColumn.Beside, { enableScripts: true, retainContextWhenHidden: true });
  panel.webview.html = html;
}

async function explain(code) {
  const page = await askServer("cnctrans.explain", code);
  const document = await vscode.workspace.openTextDocument({ language: "markdown", content: `# ${page.heading}\n\n${page.markdown}` });
  await vscode.window.showTextDocument(document, vscode.ViewColumn.Beside);
}

async function activate(context) {
  const settings = () => settingsFrom(vscode.workspace.getConfiguration("cnctrans"));
  const command = vscode.workspace.getConfiguration("cnctrans").get("command");
  const run = { command, args: ["lsp"], transport: TransportKind.stdio };
  client = new LanguageClient("cnctrans", "CNC part programs", { run, debug: run }, {
    documentSelector: languages.map((l) => ({ language: l.id })),
    initializationOptions: settings(),
    // The server's commands are asked for by this extension's own; only explain is called by a quick fix.
    middleware: { executeCommand: (name, args, next) => (name === "cnctrans.explain" ? explain(args[0]) : next(name, args)) },
  });
  context.subscriptions.push(
    vscode.commands.registerCommand("cnctrans.translateTo", translateTo),
    vscode.commands.registerCommand("cnctrans.showToolPath", showToolPath),
    vscode.workspace.onDidChangeConfiguration((e) => {
      if (e.affectsConfiguration("cnctrans")) client.sendNotification("workspace/didChangeConfiguration", { settings: { cnctrans: settings() } });
    }),
  );
  await client.start();
}

module.exports = { activate, deactivate: () => client && client.stop() };
