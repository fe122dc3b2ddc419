// What needs no editor, so that a test in node can use it.
const languages = [
  { id: "fagor", title: "Fagor 8055" },
  { id: "num", title: "NUM 760/1060" },
  { id: "sinumerik", title: "Sinumerik 840D" },
  { id: "heidenhain", title: "Heidenhain iTNC 530" },
];

function settingsFrom(configuration) {
  return { machine: configuration.get("machine") || "", libraries: configuration.get("libraries") || [] };
}

/** Why there is no translation, as a page. */
function translationText(done) {
  const lines = done.messages.map((m) => `- line ${m.line}: **${m.severity} ${m.code}** ${m.message}${m.hint ? ` (${m.hint})` : ""}`);
  return `# Not translated\n\n${done.verdict}\n\n${lines.join("\n")}\n`;
}

module.exports = { languages, settingsFrom, translationText };
