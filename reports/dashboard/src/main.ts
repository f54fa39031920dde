import { readDigest } from "./data";
const digest = readDigest();
document.getElementById("app")!.textContent = `${digest.reports.length} reports`;
